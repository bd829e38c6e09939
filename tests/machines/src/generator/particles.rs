//! Particles: coordinates with metrics, potentials and constraints of all kinds, nonlinear ones too.

use super::{Draft, Random};

/// A particle, or several.
pub(super) fn machine(draft: &mut Draft, random: &mut Random) -> &'static str {
    let coordinates = 3 + random.below(3);
    let x: Vec<String> = ["x", "y", "z", "p", "q"][..coordinates].iter().map(ToString::to_string).collect();
    draft.base.clone_from(&x);
    let rate: Vec<String> = x.iter().map(|name| format!("der({name})")).collect();
    for index in 0..coordinates {
        let mass = draft.parameter("m");
        let mut form = rate[index].clone();
        if random.happens(40) {
            let other = random.below(coordinates);
            let by = shape(draft, random, &x);
            if other != index {
                form = format!("{form} + {by}*{}", rate[other]);
            }
        }
        draft.lagrangian.push(format!("{mass}/2*({form})^2"));
    }
    if random.happens(50) {
        let stiffness = draft.parameter("k");
        let at = &x[random.below(coordinates)];
        draft.lagrangian.push(format!("-{stiffness}/2*{at}^2"));
    }
    if random.happens(30) {
        let charge = draft.parameter("b");
        draft.lagrangian.push(format!("{charge}*x*{}", rate[1]));
    }
    for name in &x {
        draft.push(random, name, &format!("der({name})"));
    }
    if random.happens(25) {
        let bound = draft.parameter("a");
        draft.constraints.push(match random.below(3) {
            0 => format!("{}^2 + {}^2 = {bound}^2*{}^2;", rate[0], rate[1], rate[2]),
            1 => format!("{}^2 + {}^2 = {bound}^2;", rate[0], rate[1]),
            _ => format!("{bound}*{}*{} = {}^2;", rate[0], rate[1], rate[2]),
        });
        return "particles, nonlinear";
    }
    let constraints = 1 + random.below(coordinates - 1);
    for index in 0..constraints {
        let left = &rate[coordinates - 1 - index];
        let mut right: Vec<String> = Vec::new();
        for k in 0..coordinates - constraints {
            if random.happens(60) {
                let by = shape(draft, random, &x);
                right.push(format!("{by}*{}", rate[k]));
            }
        }
        if random.happens(15) {
            right.push(draft.parameter("c"));
        }
        let right = if right.is_empty() { rate[0].clone() } else { right.join(" + ") };
        let equation = if random.happens(70) {
            format!("{left} = {right};")
        } else {
            format!("{}*{left} - ({right}) = 0;", shape(draft, random, &x))
        };
        draft.constraints.push(equation);
    }
    "particles"
}

/// A function of one of the coordinates.
fn shape(draft: &mut Draft, random: &mut Random, coordinates: &[String]) -> String {
    let x = &coordinates[random.below(coordinates.len())];
    match random.below(6) {
        0 => draft.parameter("e"),
        1 => x.clone(),
        2 => format!("sin({x})"),
        3 => format!("{}*cos({x})", draft.parameter("e")),
        4 => format!("{}*{x}", draft.parameter("e")),
        _ => format!("({} + {x}^2)", draft.parameter("e")),
    }
}
