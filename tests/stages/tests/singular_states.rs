//! States where the equations are singular are told where there are some, told as a condition where that was not decided,
//! and not told where there are none.

use nh_stages::declarations;

/// What the report of a declaration says of singular equations.
fn told(sections: &str) -> String {
    let text = format!("#[nonholonomic({sections})]\nstruct Machine {{ a: f64 }}");
    let system = declarations(&text).pop().expect("one declaration").system();
    let report = system.unwrap_or_else(|errors| panic!("{sections}: {errors:?}")).report;
    report.lines().filter(|line| line.contains("singular")).map(str::trim).collect::<Vec<_>>().join("; ")
}

#[test]
fn singular_states_that_are_told_exist() {
    for (sections, expected) in [
        // on both parts, x = ±√(1 + y²), twice x is not that root
        (
            "base { x, y, z } lagrangian { (der(x)^2 + der(y)^2 + (2*x - sqrt(y^2 + 1))*der(z)^2)/2 } \
             holonomic { x^2 = 1 + y^2; }",
            "",
        ),
        // a fifth power that takes every value
        (
            "base { x, y } lagrangian { (der(x)^2 - 4*der(y)^2)/2 } holonomic { x = y^2 + y^5; }",
            "the equations are singular where (2*y + 5*y^4)^2 - 4 = 0",
        ),
        // beyond the embedded base, and on it
        (
            "base { x, y, z } basis { w, v } on { x^2 + y^2 = 1; } \
             anchor { der(x) = -y*w; der(y) = x*w; der(z) = v; } lagrangian { (w^2 + (x - 2)*v^2)/2 }",
            "",
        ),
        (
            "base { x, y, z } basis { w, v } on { x^2 + y^2 = 1; } \
             anchor { der(x) = -y*w; der(y) = x*w; der(z) = v; } lagrangian { (w^2 + (2*x - 1)*v^2)/2 }",
            "the mass matrix is singular where 2*x - 1 = 0",
        ),
        // for no parameters as they are assumed: 3 a x = x² + 1 asks for 3 a ≥ 2
        (
            "base { x, y, z } lagrangian { (der(x)^2 - der(y)^2 + der(z)^2)/2 } \
             constraints { (x^2 + 1)*der(y) = 3*a*x*der(z); } assume { a > 0; a < 1/2; }",
            "the mass matrix is singular if -9*x^2*a^2/(x^2 + 1)^2 + 1 = 0 in some state; whether it is in any was not \
             decided",
        ),
        (
            "base { x, y, z } lagrangian { (der(x)^2 - der(y)^2 + der(z)^2)/2 } \
             constraints { (x^2 + 1)*der(y) = 3*a*x*der(z); } assume { a > 0; a < 1; }",
            "for some parameters the mass matrix is singular where -9*x^2*a^2/(x^2 + 1)^2 + 1 = 0",
        ),
        // for a below 1/12 alone: inertias may be of any size
        (
            "base { x, y } lagrangian { a*(der(x)^2 + der(y)^2)/2 + cos(x)/12*der(x)*der(y) }",
            "for some parameters the mass matrix is singular where a^2 - cos(x)^2/144 = 0",
        ),
        // determinants that are not written out: eigenvalues that change their sign, or do not, or were not asked
        (
            "base { q[4] } lagrangian { dot(der(q), der(q))/2 \
             + a*sin(q[0])*(der(q[0])*der(q[1]) + der(q[1])*der(q[2]) + der(q[2])*der(q[3])) }",
            "for some parameters the mass matrix is singular in some states: eigenvalues of its block of 4 coupled rows \
             change their sign",
        ),
        (
            "base { q[4] } lagrangian { dot(der(q), der(q))/2 \
             + sin(q[0])/4*(der(q[0])*der(q[1]) + der(q[1])*der(q[2]) + der(q[2])*der(q[3])) }",
            "in which states the mass matrix may be singular was not asked of the block of 4 coupled rows",
        ),
        (
            "base { q[4] } lagrangian { dot(der(q), der(q))/2 \
             + a*(der(q[0])*der(q[1]) + der(q[1])*der(q[2]) + der(q[2])*der(q[3])) }",
            "",
        ),
        // beside a pole, signs change there, too
        (
            "base { q[4] } lagrangian { dot(der(q), der(q))/2 \
             + a/q[0]*(der(q[0])*der(q[1]) + der(q[1])*der(q[2]) + der(q[2])*der(q[3])) }",
            "in which states the mass matrix may be singular was not asked of the block of 4 coupled rows",
        ),
    ] {
        assert_eq!(told(sections), expected, "{sections}");
    }
}
