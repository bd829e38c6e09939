//! Arms in space, as engineers declare them: rotations about axes that are orthogonal, parallel or neither, links
//! between these, bodies by `kinetic`.

use std::fmt::Write;

use super::{Family, declared};

pub(super) const FAMILIES: &[Family] = &[
    Family { name: "arm in space", source: orthogonal, sizes: &[2, 6, 9, 12] },
    Family { name: "arm in space, parallel axes", source: parallel, sizes: &[2, 6, 9, 12] },
    Family { name: "arm in space, skew axes", source: skew, sizes: &[2, 6, 9, 12] },
    Family { name: "fast arm in space, on wheels", source: on_a_platform, sizes: &[2, 6, 9, 12] },
    Family { name: "fast arm in space, afloat", source: on_a_floating_body, sizes: &[2, 6, 9, 12] },
];

/// A rotation about an axis that is orthogonal to the one before it, and to the link between them.
fn across(k: usize) -> String {
    format!("rot_{}(q[{k}])", ["x", "y"][k % 2])
}

/// Places and attitudes of links, their `kinetic`s and weights: `(lets, terms of L, fields)`. The centre of mass is on the
/// link, or beside it.
fn links(
    n: usize,
    base: (&str, &str),
    (turn, beside): (impl Fn(usize) -> String, bool),
) -> (String, String, String) {
    let (mut lets, mut bodies) = (String::new(), Vec::new());
    for k in 0..n {
        let (place, attitude) = match k.checked_sub(1) {
            None => (base.0.to_owned(), base.1.to_owned()),
            Some(h) => (format!("(o{h} + R{h} * [0, 0, l[{h}]])"), format!("R{h} * ")),
        };
        let _ = write!(lets, "let R{k} = {attitude}{}; let o{k} = {place}; ", turn(k));
        let aside = if beside { format!("a[{k}]") } else { "0".to_owned() };
        let _ = write!(lets, "let p{k} = o{k} + R{k} * [{aside}, 0, c[{k}]]; ");
        bodies.push(format!("kinetic(m[{k}], J[{k}], p{k}, R{k}) - m[{k}] * g * p{k}[2]"));
    }
    let aside = if beside { format!("a: [f64; {n}], ") } else { String::new() };
    let fields = format!("m: [f64; {n}], J: [[f64; 3]; {n}], l: [f64; {n}], {aside}c: [f64; {n}], g: f64");
    (lets, bodies.join(" + "), fields)
}

fn torques(n: usize) -> String {
    format!("inputs {{ u[{n}] }} forces {{ for i in 0..{n} {{ q[i]: u[i]; }} }}")
}

/// On the ground.
fn orthogonal(n: usize) -> String {
    let (lets, bodies, fields) = links(n, ("[0, 0, 0]", ""), (across, false));
    declared(&format!("base {{ q[{n}] }} {lets} lagrangian {{ {bodies} }} {}", torques(n)), &fields)
}

/// As of robots in factories: an axis along the link before it, then two that are parallel, over and over again.
fn parallel(n: usize) -> String {
    let turn = |k| format!("rot_{}(q[{k}])", ["z", "y", "y"][k % 3]);
    let (lets, bodies, fields) = links(n, ("[0, 0, 0]", ""), (turn, true));
    declared(&format!("base {{ q[{n}] }} {lets} lagrangian {{ {bodies} }} {}", torques(n)), &fields)
}

/// Each axis at an angle to the one before it.
fn skew(n: usize) -> String {
    let turn = |k| format!("rot_x(s[{k}]) * rot_z(q[{k}])");
    let (lets, bodies, fields) = links(n, ("[0, 0, 0]", ""), (turn, true));
    declared(
        &format!("base {{ q[{n}] }} {lets} lagrangian {{ {bodies} }} {}", torques(n)),
        &format!("{fields}, s: [f64; {n}]"),
    )
}

/// On four wheels with rollers, at the level where bounds on rounding errors do not matter: those of whole mass matrices
/// are smaller from some length on, since a light platform carries a heavy arm.
fn on_a_platform(n: usize) -> String {
    let (lets, bodies, fields) = links(n, ("[x, y, h]", "P * "), (across, false));
    declared(
        &format!(
            "base {{ x, y, yaw, wheel[4], q[{n}] }} let P = rot_z(yaw); let corner = [[e, f, r], [e, -f, r], [-e, f, r], [-e, -f, r]]; let hub[k in 0..4] = [x, y, 0] + P * corner[k]; let slant = [1, -1, -1, 1]; {lets} lagrangian {{ kinetic(M, [0, 0, I], [x, y, r], P) + sum(k in 0..4: kinetic(mw, [Aw, Cw, Aw], hub[k], P * rot_y(wheel[k]))) + {bodies} }} constraints {{ for k in 0..4 {{ dot(P * [1, slant[k], 0], velocity_at(hub[k], P * rot_y(wheel[k]), hub[k] - [0, 0, r])) = 0; }} }} inputs {{ drive[4], u[{n}] }} forces {{ wheel: drive; for i in 0..{n} {{ q[i]: u[i]; }} }} accuracy {{ fast }}"
        ),
        &format!("{fields}, M: f64, I: f64, mw: f64, Aw: f64, Cw: f64, e: f64, f: f64, r: f64, h: f64"),
    )
}

/// At the same level, for the same reason.
fn on_a_floating_body(n: usize) -> String {
    let (lets, bodies, fields) = links(n, ("p + R * [0, 0, h]", "R * "), (across, false));
    declared(
        &format!(
            "base {{ p[3], yaw, pitch, roll, q[{n}] }} let R = rot_z(yaw) * rot_y(pitch) * rot_x(roll); {lets} lagrangian {{ kinetic(M, I, p, R) - M * g * p[2] + {bodies} }} {} accuracy {{ fast }}",
            torques(n)
        ),
        &format!("{fields}, M: f64, I: [f64; 3], h: f64"),
    )
}
