//! The declarations that are timed: the systems of the benchmark, and families of growing size.

use crate::syntax;

/// A declaration as text.
pub(crate) struct Declaration {
    /// The name in the tables.
    pub(crate) name: String,
    /// What stands in `#[nonholonomic(…)]`.
    pub(crate) attribute: String,
    /// The struct.
    pub(crate) item: String,
    /// The family and the size in it, if it belongs to one.
    pub(crate) member: Option<(&'static str, usize)>,
    /// Parameters of ordinary size, as fields.
    pub(crate) ordinary: String,
}

impl Declaration {
    /// A system of `tests/models` with the struct and the sections that a file of the benchmark adds.
    fn of_benchmark(name: &str, model: &str, source: &str) -> Self {
        let models = include_str!("../../../../models/src/lib.rs");
        let (_, rule) = models.split_once(&format!("macro_rules! {model} {{")).expect("a model");
        let (_, rest) = rule.split_once("nonholonomic(").expect("a declaration");
        let (sections, _) = rest.split_once("$($sections)*").expect("the end of its sections");
        let (_, used) = source.split_once(&format!("nh_models::{model}! {{")).expect("its use");
        let (_, rest) = used.split_once("pub struct").expect("a struct");
        let (fields, rest) = rest.split_once('}').expect("the end of the struct");
        let (more, _) = rest.split_once("\n\n").expect("the end of its use");
        let more = more.trim_end().strip_suffix('}').expect("a brace");
        Self {
            name: name.to_owned(),
            attribute: format!("{sections}{more}"),
            item: format!("struct{fields}}}"),
            member: None,
            ordinary: String::new(),
        }
    }
}

impl Declaration {
    /// The same with `constants` in place of the fields, all of different values.
    pub(crate) fn with_constants(mut self) -> Self {
        let (attribute, item) = (self.attribute.parse(), self.item.parse());
        let Ok(parsed) = syntax::parse(attribute.expect("tokens"), item.expect("tokens")) else {
            panic!("{}: syntax", self.name)
        };
        let mut values = (0..).map(|k: u32| format!("{}", f64::from(37 + 29 * k % 101) / 64.0));
        let mut constants = String::new();
        for field in &parsed.structure.parameters {
            let entries: Vec<String> =
                values.by_ref().take(field.lengths.iter().product::<u32>() as usize).collect();
            let value =
                if field.lengths.is_empty() { entries.concat() } else { format!("[{}]", entries.join(", ")) };
            constants.extend([field.name.text.as_str(), " = ", &value, "; "]);
        }
        self.attribute = format!("constants {{ {constants} }} {}", self.attribute);
        Self { item: "struct System {}".to_owned(), ordinary: String::new(), ..self }
    }
}

/// Every declaration.
pub(crate) fn all() -> Vec<Declaration> {
    let mut all = vec![
        Declaration::of_benchmark("sleigh", "sleigh", include_str!("../../systems/sleigh.rs")),
        sleigh_without_position(),
        Declaration::of_benchmark("veselova", "veselova", include_str!("../../systems/veselova.rs")),
        Declaration::of_benchmark("snakeboard", "snakeboard", include_str!("../../systems/snakeboard.rs")),
        Declaration::of_benchmark("robot", "robot", include_str!("../../systems/robot.rs")),
        Declaration::of_benchmark("ball on table", "ball", include_str!("../../systems/ball.rs")),
    ];
    let trailers = [1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20];
    all.extend(trailers.map(relative_tractor));
    all.extend(trailers.map(absolute_tractor));
    all.extend([2, 3, 4, 6, 8, 12, 16, 20].map(snake));
    all.extend([4, 5, 6].map(suslov));
    all
}

/// The sleigh of which a scene needs the velocities alone.
fn sleigh_without_position() -> Declaration {
    let source = include_str!("../../systems/sleigh.rs");
    let mut declaration = Declaration::of_benchmark("sleigh, velocities alone", "sleigh", source);
    declaration.attribute.push_str("track { omega, v1 }");
    declaration
}

/// A tractor with trailers in relative angles: that of the benchmark, without Jacobians.
pub(crate) fn relative_tractor(trailers: usize) -> Declaration {
    let source = include_str!("../../systems/tractor.rs");
    let mut declaration =
        Declaration::of_benchmark(&format!("relative tractor {trailers}"), "tractor", source);
    for text in [&mut declaration.attribute, &mut declaration.item] {
        *text = text
            .replace("$trailers", &trailers.to_string())
            .replace("$n", &trailers.to_string())
            .replace("$bodies", &(trailers + 1).to_string())
            .replace("$Tractor", "Tractor")
            .replace("emit { jacobian }", "");
    }
    declaration.member = Some(("tractor, relative angles", trailers));
    declaration.ordinary =
        format!("m: [1.2; {0}], J: [0.3; {0}], d: [0.9; {trailers}], a: 0.25", trailers + 1);
    declaration
}

/// The same in absolute angles.
pub(crate) fn absolute_tractor(trailers: usize) -> Declaration {
    let (n, bodies) = (trailers, trailers + 1);
    let chain = format!(
        "let vx[i in 0..{bodies}] = v + sum(j in 1..i+1: d[j] * sin(th[j] - th[0]) * w[j]);
         let vy[i in 0..{bodies}] = side - sum(j in 1..i+1: d[j] * cos(th[j] - th[0]) * w[j]);"
    );
    Declaration {
        name: format!("absolute tractor {n}"),
        attribute: format!(
            "base {{ x, y, th[{bodies}] }}
            basis {{ v, side, w[{bodies}] }}
            anchor {{
                der(x) = v * cos(th[0]) - side * sin(th[0]);
                der(y) = v * sin(th[0]) + side * cos(th[0]);
                for i in 0..{bodies} {{ der(th[i]) = w[i]; }}
            }}
            lagrangian {{
                {chain}
                m[0] / 2 * (v^2 + (side + a * w[0])^2) + sum(i in 0..{bodies}: J[i] / 2 * w[i]^2)
                    + sum(i in 1..{bodies}: m[i] / 2 * (vx[i]^2 + vy[i]^2))
            }}
            constraints {{
                {chain}
                for i in 0..{bodies} {{ cos(th[i] - th[0]) * vy[i] = sin(th[i] - th[0]) * vx[i]; }}
            }}
            inputs {{ push, steer }}
            forces {{ v: push; w[0]: steer; }}"
        ),
        item: format!(
            "struct Tractor {{ m: [f64; {bodies}], J: [f64; {bodies}], d: [f64; {bodies}], a: f64 }}"
        ),
        member: Some(("tractor, absolute angles", n)),
        ordinary: format!("m: [1.2; {bodies}], J: [0.3; {bodies}], d: [0.9; {bodies}], a: 0.25"),
    }
}

/// A snake: links with a wheel in their middle, hinged at their ends, with torques at the hinges.
pub(crate) fn snake(links: usize) -> Declaration {
    let joints = links - 1;
    let chain = format!(
        "let ang[i in 0..{links}] = sum(j in 0..i: q[j]);
         let w[i in 0..{links}] = omega + sum(j in 0..i: dq[j]);
         let vx[i in 0..{links}] = v + sum(j in 0..i: h * (sin(ang[j]) * w[j] + sin(ang[j+1]) * w[j+1]));
         let vy[i in 0..{links}] = side - sum(j in 0..i: h * (cos(ang[j]) * w[j] + cos(ang[j+1]) * w[j+1]));"
    );
    Declaration {
        name: format!("snake {links}"),
        attribute: format!(
            "base {{ x, y, th, q[{joints}] }}
            basis {{ v, side, omega, dq[{joints}] }}
            anchor {{
                der(x) = v * cos(th) - side * sin(th);
                der(y) = v * sin(th) + side * cos(th);
                der(th) = omega;
                for i in 0..{joints} {{ der(q[i]) = dq[i]; }}
            }}
            lagrangian {{
                {chain}
                sum(i in 0..{links}: m / 2 * (vx[i]^2 + vy[i]^2) + J / 2 * w[i]^2)
            }}
            constraints {{
                {chain}
                side = 0;
                for i in 1..{links} {{ cos(ang[i]) * vy[i] = sin(ang[i]) * vx[i]; }}
            }}
            inputs {{ torque[{joints}] }}
            forces {{ for i in 0..{joints} {{ q[i]: torque[i]; }} }}"
        ),
        item: "struct Snake { m: f64, J: f64, h: f64 }".to_owned(),
        member: Some(("snake", links)),
        ordinary: "m: 1.2, J: 0.3, h: 0.5".to_owned(),
    }
}

/// Suslov's problem on so(n) of Fedorov and Kozlov: only the rotations that move the last axis are
/// free; the inertia is ω ↦ Jω + ωJ with any symmetric J.
pub(crate) fn suslov(n: usize) -> Declaration {
    let pairs: Vec<(usize, usize)> = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))).collect();
    let name = |i: usize, j: usize| format!("w{i}{j}");
    let names: Vec<String> = pairs.iter().map(|&(i, j)| name(i, j)).collect();
    // T = ½ Σ J_ij ω_ik ω_jk
    let entry = |i: usize, j: usize| match i.cmp(&j) {
        std::cmp::Ordering::Less => name(i, j),
        std::cmp::Ordering::Equal => "0".to_owned(),
        std::cmp::Ordering::Greater => format!("(-{})", name(j, i)),
    };
    let mut terms = Vec::new();
    for (i, j, k) in (0..n).flat_map(|i| (0..n).flat_map(move |j| (0..n).map(move |k| (i, j, k)))) {
        if k != i && k != j {
            let (i_low, j_low) = (i.min(j), i.max(j));
            terms.push(format!("J[{i_low}][{j_low}] * {} * {}", entry(i, k), entry(j, k)));
        }
    }
    let fixed = pairs.iter().filter(|(_, j)| *j < n - 1).map(|&(i, j)| format!("{} = 0;", name(i, j)));
    let names = names.join(", ");
    Declaration {
        name: format!("so({n}) Suslov"),
        attribute: format!(
            "basis {{ {names} }} brackets so({n}) {{ {names} }}
            lagrangian {{ ({}) / 2 }} constraints {{ {} }}",
            terms.join(" + "),
            fixed.collect::<String>()
        ),
        item: format!("struct Suslov {{ J: [[f64; {n}]; {n}] }}"),
        member: Some(("Suslov on so(n)", n)),
        ordinary:
            "J: core::array::from_fn(|i| core::array::from_fn(|j| if i == j { 1.0 + i as f64 } else { 0.1 }))"
                .to_owned(),
    }
}
