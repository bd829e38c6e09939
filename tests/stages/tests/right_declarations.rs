//! Declarations that are right and unusual: arcs inside of sines, logarithms of products, roots of roots, redundant
//! angles, other coordinates, sines and exponentials of velocities that constraints determine.

use nh_stages::{declarations, errors};

const RIGHT: &str = r"
#[nonholonomic(base { a, p[2], b, q[2], c } let along(z) = [cos(z), sin(z)];
 let load = q + e*along(c) + f*[-sin(c), cos(c)];
 holonomic { cross: p = l/2*along(a); roller: p[1] - l/2*sin(b) = 0; hinge: q = p + l/2*along(b); slide: dot(l*along(a) - q, [-sin(c), cos(c)]) = 0; }
 lagrangian { kinetic(m, J, l/2*along(a), a) + kinetic(m, J, p, b) + kinetic(M, K, load, c) - m*g*p[1] - M*g*load[1] })]
struct ScissorLift { l: f64, m: f64, J: f64, M: f64, K: f64, e: f64, f: f64, g: f64 }
#[nonholonomic(base { x, y, theta, c[3] } let e(z) = [cos(z), sin(z)];
 let wheel[k in 0..3] = [x, y] + b*e(theta + 2*pi*k/3) - d*e(theta + c[k]);
 constraints { for k in 0..3 { across: dot(der(wheel[k]), [-sin(theta + c[k]), cos(theta + c[k])]) = 0; } }
 lagrangian { kinetic(m, J, [x, y] + a*e(theta), theta) + K/2*dot(der(c), der(c)) } assume { d > 0; m > 0; J > 0; K > 0; }
 emit { splitting })]
struct Casters { m: f64, J: f64, K: f64, a: f64, b: f64, d: f64 }
#[nonholonomic(base { x, y, z } holonomic { flat: y = 0; b: l*(sin(x) - sin(z)) = 0; } lagrangian { m/2*(der(x)^2+der(y)^2+der(z)^2) })]
struct LengthAsFactor { l: f64, m: f64 }
#[nonholonomic(base { a } let p = l2 * sin(a); let q = l1 - l2 * cos(a); let r2 = p^2 + q^2;
 let b = atan2(p, q) + acos((r2 + l3^2 - l4^2) / (2 * l3 * sqrt(r2)));
 lagrangian { J1/2*der(a)^2 + J2/2*der(b)^2 })]
struct FourBar { l1: f64, l2: f64, l3: f64, l4: f64, J1: f64, J2: f64 }
#[nonholonomic(base { c, s } on { c^2 + s^2 = 1; } basis { w } anchor { der(c) = -s*w; der(s) = c*w; }
 lagrangian { J/2*w^2 - k*sqrt(2 - c) + h*asin(s/2) - k*(c^2 + s^2 - s^2)^2 + k/sqrt(1 - c) })]
struct OnOneInside { J: f64, k: f64, h: f64 }
#[nonholonomic(base { g[3] } on { dot(g, g) = 1; } basis { w[3] } anchor { der(g) = cross(g, w); } brackets so(3) { w }
 lagrangian { J/2*dot(w, w) - k*sqrt(1 - g[2]) })]
struct AtThePole { J: f64, k: f64 }
#[nonholonomic(base { x, y } holonomic { circle: x^2 + y^2 = l^2; }
 lagrangian { m/2*(der(x)^2 + der(y)^2) - k*sqrt(2*l^2 + h^2 + 2*l*y) })]
struct Spring { m: f64, k: f64, l: f64, h: f64 }
#[nonholonomic(base { x, y, z } lagrangian { ((x-1)^2*der(x)^2 + (m+x)*der(y)^2 + sin(x)^2*der(z)^2)/2 - k*sqrt(x) }
 constraints { der(x) + (1-cos(x))*der(y) + (x-a)*der(z) = 0; x*y*der(x) + (2+sin(y))*der(y) + a*x*der(z) = 0; } assume { m>0; }
 emit { symmetric_projection } auxiliary { der(q) = (a - q)*m; })]
struct HeldByConstraints { a: f64, m: f64, c: f64, k: f64 }
#[nonholonomic(base { a } let s = asin(r*sin(a)/l);
 lagrangian { J/2*der(a)^2 + K/2*der(s)^2 })]
struct Crank { r: f64, l: f64, J: f64, K: f64 }
#[nonholonomic(base { x, y } let ph = atan2(y, x); let r = sqrt(x^2+y^2);
 lagrangian { m/2*(der(r)^2 + r^2*der(ph)^2) })]
struct Polar { m: f64 }
#[nonholonomic(base { x, y } let ph = atan2(y, x); let r = sqrt(x^2+y^2);
 lagrangian { m/2*(der(r)^2 + r^2*der(ph)^2) } conserved { spin = m*(x*der(y)-y*der(x)); })]
struct PolarSpin { m: f64 }
#[nonholonomic(base { x, y } lagrangian { m/2*(der(x)^2+der(y)^2) - k/2*atan2(y,x)^2 } conserved { h = m/2*(der(x)^2+der(y)^2) + k/2*atan2(y,x)^2; })]
struct Spiral { m: f64, k: f64 }
#[nonholonomic(base { x, y } constraints { turn: der(atan2(y, x)) = w; } lagrangian { m/2*(der(x)^2+der(y)^2) })]
struct Swept { m: f64, w: f64 }
#[nonholonomic(base { x, y } holonomic { ray: atan2(y, x) = w*t; } lagrangian { m/2*(der(x)^2+der(y)^2) })]
struct Ray { m: f64, w: f64 }
#[nonholonomic(base { x, y } holonomic { el: sqrt((x-c)^2+y^2) + sqrt((x+c)^2+y^2) = 2*a; } lagrangian { m/2*(der(x)^2+der(y)^2) - m*g*y })]
struct Ellipse { m: f64, g: f64, a: f64, c: f64 }
#[nonholonomic(base { x, y } holonomic { el: acos(x/2) + acos(y/2) = 2; } lagrangian { m/2*(der(x)^2+der(y)^2) - m*g*y })]
struct ArcSum { m: f64, g: f64 }
#[nonholonomic(base { s } let x = ln(cosh(s)); let y = 2*atan(tanh(s/2)); lagrangian { m/2*(der(x)^2+der(y)^2) } conserved { e = m/2*(tanh(s)^2*der(s)^2 + der(s)^2/cosh(s)^2); })]
struct Catenary { m: f64 }
#[nonholonomic(base { x, q1, q2 } let elbow = [x + l*sin(q1), l*cos(q1)]; let tip = elbow + [l*sin(q2), l*cos(q2)];
 lagrangian { cart/2*der(x)^2 + kinetic(m, J, elbow, q1) + kinetic(m, J, tip, q2) } outputs { reach = norm(tip - [x, 0]); }
 assume { cart > 0; m > 0; J > 0; l > 0; } emit { output_jacobian, bracket })]
struct Reach { cart: f64, m: f64, J: f64, l: f64 }
#[nonholonomic(base { a, x, y } basis { omega, v1, v2 }
 anchor { der(a) = omega; der(x) = v1*cos(a) - v2*sin(a); der(y) = v1*sin(a) + v2*cos(a); }
 lagrangian { J/2*omega^2 + m/2*(v1^2 + (v2 + c*omega)^2) } constraints { edge: v2 = 0; }
 outputs { speed = sqrt(v1^2 + v2^2); } emit { output_jacobian, bracket })]
struct SpeedOfASleigh { J: f64, m: f64, c: f64 }
#[nonholonomic(base { a, x, y } lagrangian { J/2*der(a)^2 + m/2*(der(x)^2 + der(y)^2) - m*g*x }
 constraints { blade: sin(a)*der(x) = cos(a)*der(y); } emit { gyroscopic })]
struct SkateOnAnIncline { J: f64, m: f64, g: f64 }
#[nonholonomic(base { x, y } lagrangian { m*der(y)^2/2 - m*sqrt(1 - der(x)^2) } emit { power })]
struct Relativistic { m: f64 }
#[nonholonomic(base { x } basis { w[3] } anchor { der(x) = w[2]; } brackets so(3) { w } almost;
 lagrangian { dot(w, I*w)/2 - k*x^2 } emit { connection })]
struct FullInertia { I: [[f64; 3]; 3], k: f64 }
#[nonholonomic(base { s } let x = asin(tanh(s)); lagrangian { m/2*der(x)^2 } conserved { p = m*der(s)/cosh(s); })]
struct Gudermann { m: f64 }
#[nonholonomic(base { s } let x = 2*atan(exp(s)); lagrangian { m/2*der(x)^2 } conserved { p = m*der(s)/cosh(s); })]
struct Mercator { m: f64 }
#[nonholonomic(base { s } let x = atan(s) + atan(1/s); lagrangian { m/2*der(s)^2 + k*x } conserved { p = der(s); })]
struct RightAngle { m: f64, k: f64 }
#[nonholonomic(base { s } let x = asin(s) + acos(s); lagrangian { m/2*der(s)^2 + k*x } conserved { p = der(s); })]
struct Complement { m: f64, k: f64 }
#[nonholonomic(base { s, q } let x = ln(s*q) - ln(s) - ln(q); lagrangian { m/2*(der(s)^2+der(q)^2) + k*x } assume { k > 0; } conserved { p = der(s); })]
struct LnProduct { m: f64, k: f64 }
#[nonholonomic(base { s } let x = sqrt(2 + 2*cos(s)); lagrangian { m/2*(der(x)^2 + (2 - x^2/2)/2*der(s)^2) })]
struct HalfAngle { m: f64 }
#[nonholonomic(base { s } lagrangian { m/2*der(s)^2 + k*(sqrt(5 + 2*sqrt(6)) - sqrt(2) - sqrt(3))*s } conserved { p = der(s); })]
struct NestedRoots { m: f64, k: f64 }
#[nonholonomic(base { s } let r = sqrt(1 + s^2); lagrangian { m/2*der(s)^2 + k*(sqrt(2*s^2 + 1 + 2*s*r) - s - r) } conserved { p = der(s); })]
struct NestedRootOfState { m: f64, k: f64 }
#[nonholonomic(base { x, y, th } let u = tan(th/2); constraints { blade: der(x)*2*u = der(y)*(1-u^2); } lagrangian { m/2*(der(x)^2+der(y)^2) + J/2*der(th)^2 } )]
struct TanHalf { m: f64, J: f64 }
#[nonholonomic(base { x, y, th } let c = (exp(th)+exp(-th))/2; lagrangian { m/2*(der(x)^2+der(y)^2) + J/2*(c^2 - sinh(th)^2)*der(th)^2 } conserved { p = der(th); })]
struct HypSum { m: f64, J: f64 }
#[nonholonomic(base { th, ph } let n = [sin(th)*cos(ph), sin(th)*sin(ph), cos(th)]; lagrangian { m/2*dot(der(n), der(n)) } conserved { c = sin(th)^2*der(ph); })]
struct Spherical { m: f64 }
#[nonholonomic(base { q0, q1, q2, q3 } on { q0^2+q1^2+q2^2+q3^2 = 1; } basis { w[3] } anchor { der(q0) = (-q1*w[0]-q2*w[1]-q3*w[2])/2; der(q1) = (q0*w[0]+q2*w[2]-q3*w[1])/2; der(q2) = (q0*w[1]+q3*w[0]-q1*w[2])/2; der(q3) = (q0*w[2]+q1*w[1]-q2*w[0])/2; } brackets so(3) { w } lagrangian { A/2*w[0]^2+B/2*w[1]^2+C/2*w[2]^2 - k*(2*(q1*q3-q0*q2)) } )]
struct Quaternion { A: f64, B: f64, C: f64, k: f64 }
#[nonholonomic(base { u, v } let x = cosh(u)*cos(v); let y = sinh(u)*sin(v); lagrangian { m/2*(der(x)^2+der(y)^2) } conserved { e = m/2*(sinh(u)^2+sin(v)^2)*(der(u)^2+der(v)^2); })]
struct Elliptic { m: f64 }
#[nonholonomic(base { u, v } let x = u*v; let y = (u^2-v^2)/2; lagrangian { m/2*(der(x)^2+der(y)^2) + k/sqrt(x^2+y^2) } conserved { e = m/2*(u^2+v^2)*(der(u)^2+der(v)^2) - 2*k/(u^2+v^2); })]
struct Parabolic { m: f64, k: f64 }
#[nonholonomic(base { x, y, a } let r = sqrt(x^2+y^2); constraints { der(a) = (x*der(y)-y*der(x))/r^2; } lagrangian { m/2*(der(x)^2+der(y)^2)+J/2*der(a)^2 })]
struct AngleState { m: f64, J: f64 }
#[nonholonomic(base { x, y, a } holonomic { follow: a = atan2(y, x); } lagrangian { m/2*(der(x)^2+der(y)^2)+J/2*der(a)^2 })]
struct AngleHolonomic { m: f64, J: f64 }
#[nonholonomic(base { a, b } let d = atan2(sin(a-b), cos(a-b)); lagrangian { J/2*(der(a)^2+der(b)^2) - k/2*d^2 } conserved { p = der(a)+der(b); })]
struct Wrapped { J: f64, k: f64 }
#[nonholonomic(base { a } let d = atan2(sin(a), cos(a)); lagrangian { J/2*der(d)^2 } conserved { p = der(a); })]
struct WrappedRate { J: f64 }
#[nonholonomic(base { x, y } let rho = (x^2+y^2)^(3/2); let s = sqrt(x^2+y^2); lagrangian { m/2*(der(x)^2+der(y)^2)*rho/s^3 + k*(rho - s*x^2 - s*y^2)*x } conserved { px = der(x); })]
struct ThreeHalves { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*(x^6)^(1/3) } conserved { e = m/2*der(x)^2 + k*x^2; })]
struct RootOfPower { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*sqrt(x^4+2*x^2+1) } conserved { e = m/2*der(x)^2 + k*(x^2+1); })]
struct PerfectSquare { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*exp(2*ln(cosh(x))) } conserved { e = m/2*der(x)^2 + k*cosh(x)^2; })]
struct ExpLn { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*sinh(ln(x)) } conserved { e = m/2*der(x)^2 + k*(x-1/x)/2; })]
struct SinhLn { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*cos(3*acos(x)) } conserved { e = m/2*der(x)^2 + k*(4*x^3-3*x); })]
struct Chebyshev { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*sin(asin(x)+acos(x))*x } conserved { e = m/2*der(x)^2 + k*x; })]
struct SinOfArcs { m: f64, k: f64 }
#[nonholonomic(base { x, y } lagrangian { m/2*(der(x)^2+der(y)^2) - k*cos(atan2(y,x))*sqrt(x^2+y^2) } conserved { e = m/2*(der(x)^2+der(y)^2) + k*x; })]
struct CosAtan { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*tan(atan(x)) } conserved { e = m/2*der(x)^2 + k*x; })]
struct TanAtan { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*atan(tan(x)) } conserved { e = m/2*der(x)^2 + k*atan(tan(x)); })]
struct AtanTan { m: f64, k: f64 }
#[nonholonomic(base { a, b, c } let q = [l2*cos(a) - l1, l2*sin(a)];
 holonomic { cx: l2*cos(a) + l3*cos(b) = l1 + l4*cos(c); cy: l2*sin(a) + l3*sin(b) = l4*sin(c); }
 lagrangian { J/2*(der(a)^2+der(b)^2+der(c)^2) })]
struct FourBarClosed { l1: f64, l2: f64, l3: f64, l4: f64, J: f64 }
#[nonholonomic(base { a } let p = l1 - l2 * cos(a); let q = l2 * sin(a); let r = sqrt(p^2+q^2);
 let b = acos((r^2 + l4^2 - l3^2) / (2 * l4 * r)) + atan2(q, p);
 let ex = l2*cos(a) - l1 + l4*cos(b); let ey = l2*sin(a) - l4*sin(b);
 lagrangian { J1/2*der(a)^2 + J2/2*der(b)^2 - k*(ex^2 + ey^2 - l3^2)*a } conserved { e = J1/2*der(a)^2 + J2/2*der(b)^2; })]
struct FourBarEnergy { l1: f64, l2: f64, l3: f64, l4: f64, J1: f64, J2: f64, k: f64 }
#[nonholonomic(base { a, x } let b = asin(r*sin(a)/l);
 lagrangian { J/2*der(a)^2 + m/2*der(x)^2 } constraints { slide: der(x) = der(r*cos(a) + l*cos(b)); } conserved { e = J/2*der(a)^2 + m/2*(r*sin(a)*der(a) + l*sin(b)*der(b))^2; })]
struct CrankSlide { r: f64, l: f64, J: f64, m: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*cos(acos(x) - asin(x)) } conserved { e = m/2*der(x)^2 + 2*k*x*sqrt(1-x^2); })]
struct CosDifference { m: f64, k: f64 }
#[nonholonomic(base { x, y } lagrangian { m/2*(der(x)^2+der(y)^2) - k*sin(2*atan2(y, x))*(x^2+y^2) } conserved { e = m/2*(der(x)^2+der(y)^2) + 2*k*x*y; })]
struct SinTwice { m: f64, k: f64 }
#[nonholonomic(base { x, y } lagrangian { m/2*(der(x)^2+der(y)^2) - k*exp(ln(x) + 2*ln(y)) } conserved { e = m/2*(der(x)^2+der(y)^2) + k*x*y^2; })]
struct ExpOfLns { m: f64, k: f64 }
#[nonholonomic(base { x, y } lagrangian { m/2*(der(x)^2+der(y)^2) - k*ln(x^2*y) } conserved { e = m/2*(der(x)^2+der(y)^2) + k*(2*ln(x) + ln(y)); })]
struct LnOfPowers { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*cosh(ln(x))*x } conserved { e = m/2*der(x)^2 + k*(x^2+1)/2; })]
struct CoshLn { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*tan(2*atan(x)) } conserved { e = m/2*der(x)^2 + 2*k*x/(1-x^2); })]
struct TanTwice { m: f64, k: f64 }
#[nonholonomic(base { x, y } lagrangian { m/2*(der(x)^2+der(y)^2) - k*ln(exp(x)*exp(y)) } conserved { e = m/2*(der(x)^2+der(y)^2) + k*(x + y); })]
struct LnOfExponentials { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*ln(exp(2*x)/exp(x - 1)) } conserved { e = m/2*der(x)^2 + k*x; })]
struct LnOfQuotient { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*x*ln(cosh(x)^2 - sinh(x)^2) - k*ln(cosh(x) + sinh(x)) } conserved { e = m/2*der(x)^2 + k*x + 5; })]
struct LnOfOne { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*x*ln((1 + tanh(x))/(1 - tanh(x))) } conserved { e = m/2*der(x)^2 + 2*k*x^2; })]
struct LnOfTanh { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*x*acos(x/(1+x^2)) } conserved { e = m/2*der(x)^2 + k*x*(pi/2 - asin(x/(1+x^2))); })]
struct ArcsOfOnePoint { m: f64, k: f64 }
#[nonholonomic(base { x } lagrangian { m/2*der(x)^2 - k*x*exp(3*ln(1+x^2)/2) } conserved { e = m/2*der(x)^2 + k*x*(1+x^2)^(3/2); })]
struct ExpOfHalves { m: f64, k: f64 }
#[nonholonomic(base { x, phi, y } lagrangian { m/2*(der(x)^2 + der(y)^2) + J/2*der(phi)^2 }
 constraints { der(x) = r*der(phi) + q*der(y); } forces { x: -c*tanh(k*der(x)); } outputs { o = sin(der(x)); p = exp(der(x)); })]
struct SmoothFriction { m: f64, J: f64, r: f64, q: f64, c: f64, k: f64 }
#[nonholonomic(base { x, phi } lagrangian { m/2*der(x)^2 + J/2*der(phi)^2 } constraints { der(x) = 2*r*der(phi)/3; }
 forces { x: -c*sin(k*der(x)) - c*exp(-der(x)/2); })]
struct RateWithAFactor { m: f64, J: f64, r: f64, c: f64, k: f64 }
#[nonholonomic(base { x, y, z, phi } lagrangian { m/2*(der(x)^2 + der(y)^2 + der(z)^2) + J/2*der(phi)^2 }
 constraints { der(x) = r*der(phi) + q*der(y); der(z) = der(x) - 2*der(y) + 1; } forces { z: -c*tanh(k*der(z)*x); })]
struct RateOfARate { m: f64, J: f64, r: f64, q: f64, c: f64, k: f64 }
#[nonholonomic(base { x, y, th } basis { v, side, w }
 anchor { der(x) = v*cos(th) - side*sin(th); der(y) = v*sin(th) + side*cos(th); der(th) = w; }
 lagrangian { m/2*(v^2 + side^2) + J/2*w^2 } constraints { side = a*w + b*v; }
 forces { v: -c*tanh(k*side^2); } outputs { o = exp(side) + sin(2*side); })]
struct SquareOfASlip { m: f64, J: f64, a: f64, b: f64, c: f64, k: f64 }
#[nonholonomic(base { x, y } auxiliary { der(s) = a*x + b*y; der(w) = sin(k*der(s)) - w; }
 lagrangian { m/2*(der(x)^2 + der(y)^2) } forces { x: -c*exp(der(s)) - w; })]
struct RatesOfAuxiliaryStates { m: f64, a: f64, b: f64, c: f64, k: f64 }
#[nonholonomic(base { x, y } auxiliary { der(s) = a*x + b*der(y); der(w) = der(s) - w; }
 lagrangian { m/2*(der(x)^2 + der(y)^2) } constraints { der(y) = c*der(x); }
 forces { x: -c*exp(k*der(s)) + sin(der(w)); } outputs { o = tanh(der(w)); } emit { jacobian, multipliers, power })]
struct JacobianOfARate { m: f64, a: f64, b: f64, c: f64, k: f64 }
#[nonholonomic(base { x, y } lagrangian { m*cosh(der(x)) + m/2*der(y)^2 } constraints { der(x) = a*der(y) + b*y*der(y); })]
struct EnergyOfARate { m: f64, a: f64, b: f64 }
#[nonholonomic(base { x, a } holonomic { rod: x = l*sin(a); } independent { der(a) }
 lagrangian { m/2*der(x)^2 + J/2*der(a)^2 } forces { x: -c*tanh(k*der(x)); } outputs { s = sin(der(x)); })]
struct FrictionInALoop { m: f64, J: f64, l: f64, c: f64, k: f64 }
#[nonholonomic(base { x, y, th } basis { v, w, side }
 anchor { der(x) = v*cos(th) - side*sin(th); der(y) = v*sin(th) + side*cos(th); der(th) = w; }
 lagrangian { m/2*(v^2 + side^2) + J/2*w^2 } constraints { side = 0; } forces { x: -c*tanh(k*der(x)); y: -c*tanh(k*der(y)); })]
struct FrictionInTheWorldsAxes { m: f64, J: f64, c: f64, k: f64 }
#[nonholonomic(base { x, phi, y } lagrangian { m/2*(der(x)^2 + der(y)^2) + J/2*der(phi)^2 }
 constraints { der(x) = r*der(phi)*(1 + s*(x + y)^2); } forces { x: -c*tanh(k*(der(x) + der(y))^3); })]
struct CubeOfASum { m: f64, J: f64, r: f64, c: f64, k: f64, s: f64 }
#[nonholonomic(base { a, b, c }
 holonomic { closure: [l1*cos(a) + l2*cos(b) - l3*cos(c) - d, l1*sin(a) + l2*sin(b) - l3*sin(c)] = 0; }
 lagrangian { J/2*(der(a)^2 + der(b)^2 + der(c)^2) } independent { der(a) }
 forces { a: -f*tanh(k*(der(a) - der(b))); b: f*tanh(k*(der(a) - der(b))); c: -f*tanh(k*der(c)); })]
struct FrictionInItsJoints { l1: f64, l2: f64, l3: f64, d: f64, J: f64, f: f64, k: f64 }
#[nonholonomic(base { x, y }
 lagrangian { m/2*(der(x)^2 + der(y)^2) - k*y^2 + atan2(2*sin(x), 2*cos(x)) - atan2(sin(x), cos(x)) })]
struct IdleByValues { m: f64, k: f64 }
#[nonholonomic(base { x, y, z } lagrangian { m/2*(der(x)^2 + der(y)^2 + der(z)^2)
 + (ln(2 + 2*x^2) - ln(1 + x^2) - ln(2))*der(z) + y^2*(atan2(x, 1) - atan(x)) })]
struct HomogeneousByValues { m: f64 }
#[nonholonomic(base { x, y, z } lagrangian { m/2*(der(x)^2 + der(y)^2) + der(z)^2 - y^2 - z^2
 + (atan(z) - asin(z/sqrt(1 + z^2)))*(der(x)*der(y) + y) } emit { jacobian, gibbs_appell })]
struct UncoupledByValues { m: f64 }
#[nonholonomic(base { x, y, th } lagrangian { m/2*(der(x)^2 + der(y)^2) + J/2*der(th)^2 }
 frame { h = cos(th)*x_dot + sin(th)*y_dot; s = cos(th)*y_dot - sin(th)*x_dot; c = th_dot; } distribution { h, c }
 forces { s: -k*y; h: k; } emit { power })]
struct PowerBesideTheDistribution { m: f64, J: f64, k: f64 }
#[nonholonomic(base { x, y, z } lagrangian { m/2*(der(x)^2 + der(y)^2 + der(z)^2) + (atan2(x, 1) - atan(x))*der(x)*der(y) }
 constraints { der(z) = y*der(x); } emit { splitting })]
struct SplitByValues { m: f64 }
#[nonholonomic(base { x, y, z } constraints { der(z) = y*der(x); } emit { splitting }
 lagrangian { m/2*((der(x) + k*atan2(y, 1)*der(y))^2 + der(y)^2 + der(z)^2) - m*k*atan(y)*der(x)*der(y) })]
struct SplitByValuesOfAMetric { m: f64, k: f64 }
";

#[test]
fn right_declarations_are_accepted() {
    let found = declarations(RIGHT);
    assert_eq!(found.len(), 82);
    let mut refused = Vec::new();
    for declaration in found {
        let errors = errors(&declaration.expanded());
        if !errors.is_empty() {
            refused.push(format!("{}: {errors:?}", declaration.name));
        }
    }
    assert!(refused.is_empty(), "{}", refused.join("\n"));
}

/// The same with a slip: none of them is accepted.
#[test]
fn slips_in_them_are_refused() {
    let mut accepted = Vec::new();
    for (right, wrong) in [
        ("+ 2*k*x*sqrt(1-x^2)", "+ 3*k*x*sqrt(1-x^2)"),
        ("+ 2*k*x*y", "- 2*k*x*y"),
        ("k*(4*x^3-3*x)", "k*(4*x^3-2*x)"),
        ("k*x*y^2", "k*x^2*y"),
        ("+ k*(x + y); })]", "+ k*(x + 2*y); })]"),
        ("+ k*x + 5", "- k*x + 5"),
        ("k*x*(pi/2 - asin(", "k*x*(pi/2 + asin("),
        ("k*x*(1+x^2)^(3/2)", "k*x*(1+x^2)^(5/2)"),
        ("k*(2*ln(x) + ln(y))", "k*(ln(x) + ln(y))"),
        ("k*(x^2+1)/2", "k*(x^2+x)/2"),
        ("2*k*x/(1-x^2)", "2*k*x/(1+x^2)"),
        ("/ (2 * l4 * r)) + atan2(q, p)", "/ (2 * l4 * r)) - atan2(q, p)"),
        ("l*sin(b)*der(b))^2", "l*cos(b)*der(b))^2"),
    ] {
        let mut with = RIGHT.split("#[").filter(|text| text.contains(right));
        let (Some(text), None) = (with.next(), with.next()) else { panic!("{right} stands in one of them") };
        let changed = format!("#[{}", text.replace(right, wrong));
        let [changed] = declarations(&changed).try_into().expect("one declaration");
        if errors(&changed.expanded()).is_empty() {
            accepted.push(wrong);
        }
    }
    assert!(accepted.is_empty(), "{accepted:?}");
}
