//! Bodies in space: satellites with rotors, Suslov's and Veselova's problems, balls and discs that roll.

use super::{Draft, Random, names};

/// A body that turns.
pub(super) fn machine(draft: &mut Draft, random: &mut Random) -> &'static str {
    match random.below(5) {
        0 | 1 => satellite(draft, random),
        2 => top(draft, random),
        3 => ball(draft, random),
        _ => disc(draft, random),
    }
}

fn turning(draft: &mut Draft, random: &mut Random) -> Vec<String> {
    let w = names("w", 3);
    draft.basis.extend(w.clone());
    draft.brackets.push("brackets so(3) { w0, w1, w2 }".into());
    for rate in &w {
        let inertia = draft.parameter("A");
        draft.lagrangian.push(format!("{inertia}/2*{rate}^2"));
    }
    if random.happens(30) {
        let product = draft.parameter("B");
        draft.lagrangian.push(format!("-{product}/16*w0*w2"));
    }
    w
}

/// A direction in the body.
fn direction(draft: &mut Draft, random: &mut Random) -> String {
    if random.happens(50) {
        return format!("w{}", random.below(3));
    }
    let terms: Vec<String> =
        (0..3).filter_map(|axis| draft.maybe(random, 70, "n").map(|n| format!("{n}*w{axis}"))).collect();
    if terms.is_empty() { "w1".into() } else { terms.join(" + ") }
}

fn satellite(draft: &mut Draft, random: &mut Random) -> &'static str {
    turning(draft, random);
    let rotors = random.below(4);
    for rotor in 0..rotors {
        let (name, rate) = (format!("psi{rotor}"), format!("d{rotor}"));
        draft.base.push(name.clone());
        draft.basis.push(rate.clone());
        draft.anchor.push(format!("der({name}) = {rate};"));
        let inertia = draft.parameter("J");
        let axis = direction(draft, random);
        draft.lagrangian.push(format!("{inertia}/2*({axis} + {rate})^2"));
        draft.push(random, &rate.clone(), &rate);
    }
    if random.happens(50) {
        let direction = direction(draft, random);
        let drift = draft.maybe(random, 25, "c").unwrap_or_else(|| "0".into());
        draft.constraints.push(format!("{direction} = {drift};"));
    }
    "satellite"
}

fn top(draft: &mut Draft, random: &mut Random) -> &'static str {
    draft.base.push("g[3]".into());
    draft.on.push("dot(g, g) = 1;".into());
    turning(draft, random);
    draft.anchor.push("der(g) = cross(g, [w0, w1, w2]);".into());
    let weight = draft.parameter("k");
    draft.lagrangian.push(format!("-{weight}*g[2]"));
    match random.below(4) {
        0 => draft.constraints.push("dot(g, [w0, w1, w2]) = 0;".into()),
        1 => {
            let rate = draft.parameter("c");
            draft.constraints.push(format!("dot(g, [w0, w1, w2]) = {rate};"));
        }
        2 => {
            let direction = direction(draft, random);
            draft.constraints.push(format!("{direction} = 0;"));
        }
        _ => {}
    }
    "top"
}

fn ball(draft: &mut Draft, random: &mut Random) -> &'static str {
    turning(draft, random);
    draft.base.extend(["x", "y"].map(String::from));
    draft.basis.extend(["vx", "vy"].map(String::from));
    draft.anchor.extend(["der(x) = vx;", "der(y) = vy;"].map(String::from));
    // the axes turn with the ball unless it is homogeneous: in any case these are the equations of a declaration
    let (mass, radius) = (draft.parameter("m"), draft.parameter("r"));
    draft.lagrangian.push(format!("{mass}/2*(vx^2 + vy^2)"));
    match draft.maybe(random, 40, "o") {
        Some(table) => {
            draft.constraints.push(format!("vx = {radius}*w1 - {table}*y;"));
            draft.constraints.push(format!("vy = -{radius}*w0 + {table}*x;"));
        }
        None => draft.constraints.extend([format!("vx = {radius}*w1;"), format!("{radius}*w0 = -vy;")]),
    }
    if random.happens(30) {
        draft.constraints.push("w2 = 0;".into());
    }
    if random.happens(40) {
        let stiffness = draft.parameter("k");
        draft.lagrangian.push(format!("-{stiffness}/2*(x^2 + y^2)"));
    }
    "ball"
}

fn disc(draft: &mut Draft, random: &mut Random) -> &'static str {
    let (mass, radius) = (draft.parameter("m"), draft.parameter("r"));
    let (along, axial) = (draft.parameter("A"), draft.parameter("C"));
    if random.happens(50) {
        // upright, with its centre of mass off the middle now and then
        draft.base.extend(["x", "y", "th", "ph"].map(String::from));
        draft.lagrangian.push(format!("{mass}/2*(der(x)^2 + der(y)^2)"));
        draft.lagrangian.push(format!("{along}/2*der(th)^2 + {axial}/2*der(ph)^2"));
        if random.happens(40) {
            let (weight, turned) = (draft.parameter("k"), draft.parameter("e"));
            draft.lagrangian.push(format!("-{weight}*cos(ph) + {turned}/16*cos(ph)*der(th)*der(ph)"));
        }
    } else {
        draft.base.extend(["x", "y", "th", "be", "ph"].map(String::from));
        draft.lagrangian.push(format!(
            "{mass}/2*((der(x) - {radius}*(cos(th)*sin(be)*der(th) + sin(th)*cos(be)*der(be)))^2
            + (der(y) - {radius}*(sin(th)*sin(be)*der(th) - cos(th)*cos(be)*der(be)))^2 + {radius}^2*sin(be)^2*der(be)^2)"
        ));
        draft.lagrangian.push(format!(
            "{along}/2*(der(be)^2 + cos(be)^2*der(th)^2) + {axial}/2*(der(ph) + sin(be)*der(th))^2"
        ));
        if random.happens(60) {
            let g = draft.parameter("g");
            draft.lagrangian.push(format!("-{mass}*{g}*{radius}*cos(be)"));
        }
    }
    draft.constraints.push(format!("der(x) = {radius}*cos(th)*der(ph);"));
    draft.constraints.push(format!("der(y) = {radius}*sin(th)*der(ph);"));
    draft.push(random, "ph", "der(ph)");
    draft.push(random, "th", "der(th)");
    "disc"
}
