use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k * y }
    impacts { floor: y >= 0 with restitution e; blade: der(x) = 0, der(y) = 0; }
)]
struct S { m: f64, e: f64 }

fn main() {
    let s = S { m: 1.0, e: 0.5 };
    let (after, impulses) = s.impact_floor(0.0, &SState::default()).unwrap();
    let _ = (after.y_dot, impulses.floor, impulses.blade[1], s.event_floor(0.0, &after));
}
