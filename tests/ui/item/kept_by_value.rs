use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - k * cos(x) }
    emit { prepared, angle_cache }
)]
struct Spring { m: f64, k: f64 }

fn main() {
    let _ = Spring { m: 1.0, k: 1.0 }.prepare();
}
