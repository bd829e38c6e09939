//! Bodies in the plane that carry each other: wheels, blades, trailers, arms, sliders, rotors.

use super::{Draft, Random};

/// A body, in the frame in which velocities are written.
#[derive(Clone, Debug)]
struct Body {
    /// The angle of its axes.
    angle: String,
    /// Its angular velocity.
    rate: String,
    /// The velocity of its origin.
    velocity: [String; 2],
    /// The height of its origin, where that is known.
    height: Option<String>,
}

impl Body {
    /// The velocity of the point at (a, b) in its axes.
    fn point(&self, a: &str, b: Option<&str>) -> [String; 2] {
        let Self { angle, rate, velocity: [x, y], .. } = self;
        let [sin, cos] = ["sin", "cos"].map(|function| format!("{function}({angle})"));
        let (across, along) = match b {
            Some(b) => (format!("({a}*{sin} + {b}*{cos})"), format!("({a}*{cos} - {b}*{sin})")),
            None => (format!("{a}*{sin}"), format!("{a}*{cos}")),
        };
        [format!("{x} - {across}*{rate}"), format!("{y} + {along}*{rate}")]
    }

    /// Its components along an axis at that angle, and across.
    fn along([x, y]: &[String; 2], angle: &str) -> [String; 2] {
        let (sin, cos) = (format!("sin({angle})"), format!("cos({angle})"));
        [format!("{cos}*({x}) + {sin}*({y})"), format!("{cos}*({y}) - {sin}*({x})")]
    }
}

/// A tree of bodies.
pub(super) fn machine(draft: &mut Draft, random: &mut Random) -> &'static str {
    let mut planar =
        Planar { draft, random, bodies: Vec::new(), held: Vec::new(), freedom: 0, moving: false };
    let family = planar.carrier();
    let more = planar.random.below(5);
    for _ in 0..more {
        planar.child();
    }
    let wheels = 1 + planar.random.below(2 + planar.bodies.len());
    for _ in 0..wheels {
        if planar.freedom > 1 {
            planar.support();
        }
    }
    family
}

struct Planar<'a> {
    draft: &'a mut Draft,
    random: &'a mut Random,
    bodies: Vec<Body>,
    /// The bodies that stand on something, each once: two blades of one body would hold it, or say the same.
    held: Vec<usize>,
    /// Velocities less constraints.
    freedom: usize,
    /// Whether velocities are written in the axes of the first body.
    moving: bool,
}

impl Planar<'_> {
    /// A velocity with its coordinate: the name of the velocity.
    fn coordinate(&mut self, name: &str) -> String {
        self.freedom += 1;
        self.draft.base.push(name.into());
        if self.moving {
            let velocity = format!("d_{name}");
            self.draft.basis.push(velocity.clone());
            self.draft.anchor.push(format!("der({name}) = {velocity};"));
            return velocity;
        }
        format!("der({name})")
    }

    fn body(&mut self, body: Body) {
        let index = self.bodies.len();
        let [x, y] = &body.velocity;
        self.draft.lets.push(format!("let a{index}_ = {};", body.angle));
        self.draft.lets.push(format!("let w{index}_ = {};", body.rate));
        self.draft.lets.push(format!("let x{index}_ = {x};"));
        self.draft.lets.push(format!("let y{index}_ = {y};"));
        let named = |letter: &str| format!("{letter}{index}_");
        let angle = if body.angle == "0" { body.angle } else { named("a") };
        self.bodies.push(Body { angle, rate: named("w"), velocity: [named("x"), named("y")], ..body });
    }

    /// The kinetic energy of the last body, and its weight.
    fn inertia(&mut self) {
        let (draft, random) = (&mut *self.draft, &mut *self.random);
        let Some(body) = self.bodies.last() else { return };
        let mass = draft.parameter("m");
        let [x, y] = match draft.maybe(random, 60, "a") {
            Some(a) => {
                let b = draft.maybe(random, 25, "b");
                if let Some(height) = &body.height
                    && random.happens(50)
                {
                    let g = draft.parameter("g");
                    draft.lagrangian.push(format!("-{mass}*{g}*({height} + {a}*sin({}))", body.angle));
                }
                body.point(&a, b.as_deref())
            }
            None => body.velocity.clone(),
        };
        draft.lagrangian.push(format!("{mass}/2*(({x})^2 + ({y})^2)"));
        if random.happens(85) {
            let inertia = draft.parameter("J");
            draft.lagrangian.push(format!("{inertia}/2*({})^2", body.rate));
        }
    }

    /// The first body.
    fn carrier(&mut self) -> &'static str {
        let zero = || "0".to_owned();
        match self.random.below(8) {
            0..3 => {
                let [x, y, w] = ["x", "y", "th"].map(|name| self.coordinate(name));
                self.body(Body { angle: "th".into(), rate: w, velocity: [x, y], height: Some("y".into()) });
                self.inertia();
                self.draft.push(self.random, "th", "der(th)");
                "planar"
            }
            3..6 => {
                self.moving = true;
                self.freedom = 3;
                self.draft.base.extend(["x", "y", "th"].map(String::from));
                self.draft.basis.extend(["v", "side", "omega"].map(String::from));
                let lines = [
                    "der(x) = v*cos(th) - side*sin(th);",
                    "der(y) = v*sin(th) + side*cos(th);",
                    "der(th) = omega;",
                ];
                self.draft.anchor.extend(lines.map(String::from));
                let velocity = ["v".to_owned(), "side".to_owned()];
                self.body(Body { angle: zero(), rate: "omega".into(), velocity, height: None });
                self.inertia();
                self.draft.push(self.random, "v", "v");
                self.draft.push(self.random, "omega", "omega");
                "planar, own axes"
            }
            6 => {
                let x = self.coordinate("x");
                self.body(Body { angle: zero(), rate: zero(), velocity: [x, zero()], height: Some(zero()) });
                let mass = self.draft.parameter("m");
                self.draft.lagrangian.push(format!("{mass}/2*der(x)^2"));
                self.draft.push(self.random, "x", "der(x)");
                self.arm();
                "planar, cart"
            }
            _ => {
                let w = self.coordinate("th");
                let velocity = [zero(), zero()];
                self.body(Body { angle: "th".into(), rate: w, velocity, height: Some(zero()) });
                self.inertia();
                "planar, pivot"
            }
        }
    }

    /// One more body.
    fn child(&mut self) {
        match self.random.below(8) {
            0..5 => self.arm(),
            5 => self.slider(),
            _ => self.rotor(),
        }
    }

    /// A body on a hinge.
    fn arm(&mut self) {
        let carrier = self.carrying();
        let name = format!("q{}", self.bodies.len());
        let rate = self.coordinate(&name);
        let at = self.draft.maybe(self.random, 75, "l");
        let aside = at.as_ref().and_then(|_| self.draft.maybe(self.random, 15, "h"));
        let velocity = match &at {
            Some(at) => carrier.point(at, aside.as_deref()),
            None => carrier.velocity.clone(),
        };
        let height = match (&carrier.height, &at) {
            (Some(height), Some(at)) if aside.is_none() => {
                Some(format!("{height} + {at}*sin({})", carrier.angle))
            }
            (height, None) => height.clone(),
            _ => None,
        };
        let is_absolute = !self.moving && self.random.happens(50);
        let (angle, rate) = if is_absolute || carrier.rate == "0" {
            (name.clone(), rate)
        } else {
            (format!("{} + {name}", carrier.angle).replace("0 + ", ""), format!("{} + {rate}", carrier.rate))
        };
        self.body(Body { angle, rate, velocity, height });
        self.inertia();
        self.spring(&name, is_absolute);
    }

    fn carrying(&mut self) -> Body {
        let last = self.bodies.len() - 1;
        let index = if self.random.happens(60) { last } else { self.random.below(last + 1) };
        self.bodies[index].clone()
    }

    /// A spring, friction or a motor on a joint.
    fn spring(&mut self, name: &str, is_absolute: bool) {
        if !is_absolute && self.random.happens(25) {
            let stiffness = self.draft.parameter("k");
            self.draft.lagrangian.push(format!("-{stiffness}/2*{name}^2"));
        }
        let velocity = if self.moving { format!("d_{name}") } else { format!("der({name})") };
        let along = if self.moving { velocity.clone() } else { name.to_owned() };
        self.draft.push(self.random, &along, &velocity);
    }

    /// A body that slides along its carrier.
    fn slider(&mut self) {
        let carrier = self.carrying();
        let name = format!("s{}", self.bodies.len());
        let rate = self.coordinate(&name);
        let [x, y] = carrier.point(&name, None);
        let [sin, cos] = ["sin", "cos"].map(|function| format!("{function}({})", carrier.angle));
        let velocity = [format!("{x} + {cos}*{rate}"), format!("{y} + {sin}*{rate}")];
        self.body(Body { velocity, height: None, ..carrier });
        self.inertia();
        self.spring(&name, false);
    }

    /// A wheel that spins about its carrier's axis: it has no mass of its own.
    fn rotor(&mut self) {
        let carrier = self.carrying();
        let name = format!("p{}", self.draft.base.len());
        let rate = self.coordinate(&name);
        let inertia = self.draft.parameter("I");
        let whole = if self.random.happens(60) { format!("({} + {rate})", carrier.rate) } else { rate };
        self.draft.lagrangian.push(format!("{inertia}/2*{whole}^2"));
        self.spring(&name, true);
    }

    /// What a body stands on.
    fn support(&mut self) {
        let index = self.random.below(self.bodies.len());
        let body = self.bodies[index].clone();
        if body.rate == "0" || self.held.contains(&index) {
            return;
        }
        self.held.push(index);
        let at = self.draft.maybe(self.random, 40, "e");
        let velocity = match &at {
            Some(at) => {
                let aside = self.draft.maybe(self.random, 20, "f");
                body.point(at, aside.as_deref())
            }
            None => body.velocity.clone(),
        };
        let kind = self.random.below(10);
        let angle = if kind == 9 {
            // steered
            let name = format!("z{}", self.draft.base.len());
            let rate = self.coordinate(&name);
            let inertia = self.draft.parameter("I");
            let whole = if self.random.happens(50) { format!("({} + {rate})", body.rate) } else { rate };
            self.draft.lagrangian.push(format!("{inertia}/2*{whole}^2"));
            self.spring(&name, true);
            if body.angle == "0" { name } else { format!("{} + {name}", body.angle) }
        } else {
            body.angle.clone()
        };
        let [forward, across] = if angle == "0" { velocity.clone() } else { Body::along(&velocity, &angle) };
        self.freedom -= 1;
        let drift = match self.random.below(12) {
            0 => self.draft.parameter("d"),
            1 => format!("{}*cos(t)", self.draft.parameter("d")),
            _ => "0".to_owned(),
        };
        let equation = match self.random.below(3) {
            0 if drift == "0" && angle != "0" => {
                let [x, y] = &velocity;
                format!("cos({angle})*({y}) = sin({angle})*({x});")
            }
            _ => format!("{across} = {drift};"),
        };
        self.draft.constraints.push(equation);
        if kind < 4 && self.freedom > 0 {
            // it rolls
            let name = format!("p{}", self.draft.base.len());
            let rate = self.coordinate(&name);
            let inertia = self.draft.parameter("I");
            let radius = self.draft.parameter("r");
            self.draft.lagrangian.push(format!("{inertia}/2*{rate}^2"));
            self.draft.constraints.push(if self.random.happens(50) {
                format!("{radius}*{rate} = {forward};")
            } else {
                format!("{forward} - {radius}*{rate} = 0;")
            });
            self.freedom -= 1;
            self.spring(&name, true);
        }
    }
}
