//! Constraints on positions: linkages, bodies on pins, particles on rods and surfaces, with blades beside.

use super::{Draft, Random};

/// Something with at least one constraint on positions.
pub(super) fn machine(draft: &mut Draft, random: &mut Random) -> &'static str {
    let mut machine = Machine { draft, random, freedom: 0 };
    let family = match machine.random.below(4) {
        0 | 1 => machine.linkage(),
        2 => machine.on_pins(),
        _ => machine.particles(),
    };
    machine.keep_some();
    family
}

struct Machine<'a> {
    draft: &'a mut Draft,
    random: &'a mut Random,
    /// Coordinates less constraints.
    freedom: usize,
}

impl Machine<'_> {
    fn coordinate(&mut self, name: &str) -> String {
        self.freedom += 1;
        self.draft.base.push(name.into());
        name.into()
    }

    fn holds(&mut self, equation: String) {
        self.freedom -= 1;
        self.draft.holonomic.push(equation);
    }

    /// A moving number: a parameter, at times with a swing in time.
    fn place(&mut self, letter: &str) -> String {
        let at = self.draft.parameter(letter);
        if self.random.happens(15) {
            let [far, fast] = ["e", "o"].map(|letter| self.draft.parameter(letter));
            return format!("({at} + {far}*sin({fast}*t))");
        }
        at
    }

    /// The kinetic energy of a bar from one point to another, its weight, a spring.
    fn bar(&mut self, from: &[String; 2], to: &[String; 2], angle: &str) {
        let index = self.draft.lagrangian.len();
        let share = self.random.one_of(&["0", "1/2", "1/3"]).to_owned();
        let names = [format!("c{index}x_"), format!("c{index}y_")];
        for (name, (from, to)) in names.iter().zip(from.iter().zip(to)) {
            self.draft.lets.push(format!("let {name} = {from} + ({to} - ({from}))*{share};"));
        }
        let mass = self.draft.parameter("m");
        let [x, y] = &names;
        self.draft.lagrangian.push(format!("{mass}/2*(der({x})^2 + der({y})^2)"));
        let inertia = self.draft.parameter("J");
        self.draft.lagrangian.push(format!("{inertia}/2*der({angle})^2"));
        if self.random.happens(50) {
            let g = self.draft.parameter("g");
            self.draft.lagrangian.push(format!("-{mass}*{g}*{y}"));
        }
        if self.random.happens(25) {
            let stiffness = self.draft.parameter("k");
            self.draft.lagrangian.push(format!("-{stiffness}/2*{angle}^2"));
        }
    }

    /// Bars one after the other from a pivot: the tip.
    fn chain(&mut self, letter: &str, bars: usize, mut joint: [String; 2]) -> [String; 2] {
        let is_relative = self.random.happens(40);
        let mut before = String::new();
        for index in 0..bars {
            let name = self.coordinate(&format!("{letter}{index}"));
            let angle = if is_relative && index > 0 { format!("({before} + {name})") } else { name.clone() };
            before.clone_from(&angle);
            let length = self.draft.parameter("r");
            let tip = [format!("{letter}x{index}_"), format!("{letter}y{index}_")];
            let reach = ["cos", "sin"].map(|function| format!("{length}*{function}({angle})"));
            for (name, (joint, reach)) in tip.iter().zip(joint.iter().zip(&reach)) {
                self.draft.lets.push(format!("let {name} = {joint} + {reach};"));
            }
            self.bar(&joint, &tip, &angle);
            self.draft.push(self.random, &name, &format!("der({name})"));
            joint = tip;
        }
        joint
    }

    /// One chain that is closed, or two that meet.
    fn linkage(&mut self) -> &'static str {
        let bars = 2 + self.random.below(3);
        let [x, y] = self.chain("a", bars, ["0", "0"].map(String::from));
        match self.random.below(5) {
            0 if bars > 2 => {
                let [px, py] = ["p", "p"].map(|letter| self.place(letter));
                self.holds(format!("closed_x: {x} = {px};"));
                self.holds(format!("closed_y: {y} = {py};"));
                "linkage, closed"
            }
            1 => {
                let [slope, height] = ["s", "h"].map(|letter| self.draft.parameter(letter));
                let moving = self.place("p");
                self.holds(format!("guide: {y} = {slope}*{x} + {height}*{moving};"));
                self.blade(&[x, y], "a0");
                "linkage, slider"
            }
            2 => {
                let [px, py, length] = ["p", "p", "r"].map(|letter| self.place(letter));
                self.holds(format!("rope: ({x} - {px})^2 + ({y} - {py})^2 = ({length} + a0)^2;"));
                "linkage, rope"
            }
            _ => {
                let pivot = self.draft.parameter("p");
                let other = self.chain("b", 2, [pivot, "0".into()]);
                self.holds(format!("joint_x: {x} = {};", other[0]));
                self.holds(format!("joint_y: {y} = {};", other[1]));
                "linkage, two chains"
            }
        }
    }

    /// A blade at a point, along a body.
    fn blade(&mut self, [x, y]: &[String; 2], angle: &str) {
        if self.freedom > 1 && self.random.happens(50) {
            self.freedom -= 1;
            self.draft.constraints.push(format!("blade: cos({angle})*der({y}) - sin({angle})*der({x}) = 0;"));
        }
    }

    /// Bodies with three coordinates each, held together by pins.
    fn on_pins(&mut self) -> &'static str {
        let bodies = 1 + self.random.below(3);
        let mut last: Option<[String; 2]> = None;
        for index in 0..bodies {
            let [x, y, angle] = ["x", "y", "th"].map(|letter| self.coordinate(&format!("{letter}{index}")));
            let [near, far] = ["r", "r"].map(|letter| self.draft.parameter(letter));
            let end = |length: &str, sign: &str| {
                [format!("{x} {sign} {length}*cos({angle})"), format!("{y} {sign} {length}*sin({angle})")]
            };
            self.bar(&[x.clone(), y.clone()], &end(&far, "+"), &angle);
            let head = end(&near, "-");
            match last.take() {
                Some(tail) => {
                    self.holds(format!("pin{index}_x: {} = {};", head[0], tail[0]));
                    self.holds(format!("pin{index}_y: {} = {};", head[1], tail[1]));
                }
                None if self.random.happens(50) => {
                    let px = self.place("p");
                    self.holds(format!("pivot_x: {} = {px};", head[0]));
                    self.holds(format!("pivot_y: {} = 0;", head[1]));
                }
                None => self.blade(&[x.clone(), y.clone()], &angle),
            }
            self.draft.push(self.random, &angle, &format!("der({angle})"));
            last = Some(end(&far, "+"));
        }
        if self.draft.holonomic.is_empty() || (self.freedom > 1 && self.random.happens(40)) {
            let [a, b] = last.unwrap_or_else(|| ["0", "0"].map(String::from));
            let radius = self.place("r");
            self.holds(format!("ring: ({a})^2 + ({b})^2 = {radius}^2;"));
        }
        "on pins"
    }

    /// Particles on rods, spheres and surfaces.
    fn particles(&mut self) -> &'static str {
        let count = 1 + self.random.below(2);
        for index in 0..count {
            let names: [String; 3] =
                ["x", "y", "z"].map(|letter| self.coordinate(&format!("{letter}{index}")));
            let mass = self.draft.parameter("m");
            let square = names.each_ref().map(|name| format!("der({name})^2")).join(" + ");
            self.draft.lagrangian.push(format!("{mass}/2*({square})"));
            if self.random.happens(60) {
                let g = self.draft.parameter("g");
                self.draft.lagrangian.push(format!("-{mass}*{g}*{}", names[2]));
            }
            for name in &names {
                self.draft.push(self.random, name, &format!("der({name})"));
            }
            let [x, y, z] = &names;
            let size = self.place("r");
            let equation = match self.random.below(4) {
                0 => format!("{x}^2 + {y}^2 + {z}^2 = {size}^2"),
                1 => format!("{z} = {size}*sin({x})*cos({y})"),
                2 => format!("{z} = {size}*{x}*{y} + {x}^2"),
                _ => format!("{x}^2 + {y}^2 = {size}*{z}^2 + {size}"),
            };
            self.holds(format!("surface{index}: {equation};"));
            if self.random.happens(50) {
                let c = self.draft.parameter("c");
                self.freedom -= 1;
                self.draft.constraints.push(format!("skate{index}: der({x}) = {c}*{z}*der({y});"));
            }
        }
        if count == 2 && self.freedom > 1 {
            let length = self.draft.parameter("r");
            self.holds(format!("rod: (x1 - x0)^2 + (y1 - y0)^2 + (z1 - z0)^2 = {length}^2;"));
        }
        "particles on surfaces"
    }

    /// Velocities that the state keeps, at times: the first coordinates, or the last.
    fn keep_some(&mut self) {
        if !self.random.happens(40) {
            return;
        }
        let mut base = self.draft.base.clone();
        if self.random.happens(50) {
            base.reverse();
        }
        let kept: Vec<String> = base.iter().take(self.freedom).map(|name| format!("der({name})")).collect();
        self.draft.choices.push(format!("independent {{ {} }}", kept.join(", ")));
    }
}
