//! The attribute macro `#[nonholonomic(…)]`: the declaration of a nonholonomic mechanical system
//! becomes verified code. Tokens come in and go out here; the mathematics is in `nh-core`.

mod derived_outline;
mod emit;
mod expand;
mod morphism;
mod quotient;
mod report;
mod resolve;
mod suggest;
mod syntax;

/// Derives the equations of motion of the declared mechanical system for the annotated struct.
///
/// The attribute's sections say how the system moves, what its Lagrangian is, and what constrains and
/// drives it; the fields of the struct are the parameters. The macro proves that the declaration is
/// well-posed, derives the equations, and emits plain Rust that allocates nothing. What is ill-posed is
/// a compile error at the token concerned: what is wrong, the evidence, a way out.
///
/// ```text
/// #[nonholonomic(
///     base        { theta, x, y }                       // coordinates
///     basis       { omega, v, side }                    // quasi-velocities
///     anchor {                                          // kinematic equations
///         der(theta) = omega;
///         der(x) = v * cos(theta) - side * sin(theta);
///         der(y) = v * sin(theta) + side * cos(theta);
///     }
///     lagrangian  { J / 2 * omega^2 + m / 2 * (v^2 + side^2) }
///     constraints { blade: side = 0; }
///     forces      { omega: torque; }
///     inputs      { torque }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// pub struct Skate { pub m: f64, pub J: f64 }
/// ```
///
/// # Sections
///
/// They come in any order, each at most once, except `brackets`. Names are separated by commas,
/// equations and other items end with `;`. Comments are Rust's; a doc comment before a declared name
/// becomes the documentation of its generated field.
///
/// | section | meaning | without it |
/// |---|---|---|
/// | `let p = …;` `let h(u, v) = …;` | values and functions that all sections know: see *Machines* | none |
/// | `constants { g = 9.81; I = [1, 2, 3]; }` | names of numbers, vectors and matrices of numbers: parameters that are known when the code is compiled. Equations are derived as with fields, and what is made of constants alone becomes a literal, so that nothing costs more than with fields. Proofs know the values: a system that is singular, or an identity that holds, for these values alone is found | none |
/// | `base { x, q[3], R[3][3] }` | coordinates xⁱ of the base, also in families | none: a Lie algebra |
/// | `on { dot(g, g) = 1; }` | identities that embedded coordinates satisfy; the anchor is proved to keep them | none |
/// | `basis { omega, w[3] }` | sections e_α; each name is also its quasi-velocity yᵅ | the velocities are those of the coordinates, `der(x)` |
/// | `anchor { der(x) = …; }` | ẋⁱ = ρⁱ_α yᵅ, linear and homogeneous in the quasi-velocities, a line per coordinate | needed with `base` and `basis` |
/// | `velocities { w = r^2 * der(phi); … }` | quasi-velocities by a coframe, instead of `basis` and `anchor` | |
/// | `brackets { [a, b] = c; }` | [e_α, e_β]; pairs not listed vanish, the mirror follows | derived from the anchor where it is injective |
/// | `brackets so(3) { w }` | a known algebra for the sections named; may be combined with others | |
/// | `frame { h = d1 - A * xi; }` | new sections as combinations of the declared ones; other sections may use them. Without `distribution` each takes the place of a declared one, whose velocity then stands for its expression; a section that stays keeps its name, which means its velocity in the new basis: `frame { …; p = xi; }` keeps `xi` apart | |
/// | `almost;` | of the declared brackets neither the Jacobi identity (3) nor (2), that the anchor is a homomorphism, is demanded; the report says which of them hold | both are proved |
/// | `lagrangian { let …; L }` | L(t, x, y) | an error |
/// | `holonomic { label: lhs = rhs; }` | position constraints, at will dependent on the time; generates `assemble` and `assemble_holding`; `redundant;` permits equations that follow from others | none |
/// | `constraints { label: lhs = rhs; }` | linear, affine or nonlinear in the velocities, at will dependent on the time | none |
/// | `impacts { floor: h >= 0 with restitution e; blade: u = 0, w = 0; }` | jumps of the velocities: gaps that close, and equations that hold afterwards; what acts together stands in one item; generates `impact_floor`, `event_floor` and a type for `advance_with_impacts` | none |
/// | `distribution { s, dpsi }`, `{ der(x) }` | sections that span the allowed velocities, instead of linear constraints; combinations get a name in `frame` | |
/// | `forces { omega: …; x: …; }` | generalized forces along a section or a coordinate | none |
/// | `auxiliary { der(current) = (volts - R * current) / Lc; }` | states without inertia, by their rates: currents, lags, filters; forces and constraints may depend on them | none |
/// | `inputs { torque }` | control inputs, constant within a step | none |
/// | `outputs { speed = …; }` | named observables | none |
/// | `conserved { spin = …; }` | claimed first integrals, proved or refused | |
/// | `symmetries { spin: omega; }` | labelled sections whose momenta are wanted, each in D or a symmetry | cyclic coordinates are found |
/// | `volume;` or `volume { density; }` | the claim that the motion keeps a volume, proved or refused; its density is found on the base, or given | |
/// | `hamilton_jacobi { omega: …; }` | momenta as functions on the base that are claimed to solve the Hamilton–Jacobi equation, proved or refused | |
/// | `routh { spin = mu; }` | conserved momenta that become parameters: their velocities leave the state | |
/// | `assume { m > 0; }` | facts about parameters: used in proofs, checked by `validate` | none |
/// | `units { x, y = m; m = kg; }` | units of declared names: everything is proved to be homogeneous, see below | not looked at |
/// | `independent { v, dphi }` | the velocities that the state keeps; beside `holonomic` and `on` also coordinates, a chart of where these hold: each kind is complete or left out | chosen by the macro |
/// | `orthonormal { u1, u2 }` | names for the velocities of a basis of D made orthonormal in the kinetic metric (Gram and Schmidt, in the order of the independent velocities): the state keeps them, and C is the identity (M 2.2) | |
/// | `formulation { projected }` | all velocities in the state, with multipliers; or `adapted` | adapted where a choice of velocities holds everywhere |
/// | `accuracy { careful }` | where emitted code stands between speed and accuracy: `fast`, `balanced` or `careful`, see below | `balanced` |
/// | `emit { jacobian, momenta }` | what to generate beyond the default: see below | |
/// | `linearization { keep: v, omega; }` | the variables of the state in which `linearize` gives a linear model on the constraint manifold, and which are steady where `trim` finds a steady motion | `linearization { }`: the independent ones |
/// | `track { v, speed }` | the state variables and outputs that matter: what does not flow into them is neither stored nor computed, nor is an output that depends on it | everything |
/// | `derivative { motor: [self.motor_speed]; }` | the partial derivatives of a method used in a force, for `emit { jacobian }` | |
/// | `names { state = RobotState; }` | names of generated types, by their roles: `state`, `velocity`, `input`, `outputs`, `multipliers`, `reactions`, `residual`, `momenta`, `phase`, `quadratures`, `gyroscopic`, `power`, `impulses`, and the lists of names `coordinate` and `variable` | `…State` and so on |
/// | `crate { ::runtime }` | the path of the runtime where the dependency is renamed | `::nonholonomic` |
///
/// # Expressions
///
/// `+ - * /`, powers `x^2` with a rational exponent (tighter than a sign, from the right), parentheses;
/// `sin cos tan asin acos atan atan2 sinh cosh tanh exp ln sqrt`, and in `forces` and `outputs` also
/// `abs sign min max`. Numbers are exact: `1/2`, `0.5` and `.5` are one half. `t` is the time, `pi` is
/// π, `der(x)` the rate of a coordinate (with a basis: its anchor expression).
///
/// ```text
/// let c = cos(theta);                       // before it is used, in any section of equations
/// sum(i in 0..3: I[i] * w[i]^2) / 2         // an empty range is 0
/// dot(w, I * w) / 2 - dot(g, [a, 0, b])     // vectors, matrices times vectors, cross(u, v)
/// for i in 0..3 { der(q[i]) = v[i]; }       // around whole items
/// ```
///
/// `v[0..2]` is a part of a vector, or of the value of any expression; the literal `0` is the zero of any shape, so that
/// `p - q = 0` is an equation between vectors. `transpose(A)`, `A * B`, `hat(v)` (`hat(v) * w` is `cross(v, w)`), `vee(A)`
/// (of the skew part), `norm(v)`, `diag(a, b, c)`, `identity(3)` are functions directly before `(` only, as are the words
/// of the next section: fields and coordinates may have these names.
///
/// Forces may call methods of the struct, `omega: self.motor(omega, throttle);`: the macro takes their
/// values as they come. Fields of other types, for the sake of such methods, are marked `#[nh(skip)]`.
///
/// # Machines
///
/// A `let …;` between the sections, with its `;`, is known in all of them, whatever the order. With arguments it is a
/// function; arguments and values are numbers, vectors or matrices. What a section cannot take, as velocities in `on`, is
/// an error where the `let` is used there.
///
/// `der(e)` is the rate of any expression of base coordinates, auxiliary states, parameters and `t` along the motion, entry by entry.
/// `diff(e, x)` is the partial derivative by a coordinate, a parameter, `t`, a velocity, or an argument of the function
/// that is defined; by a vector or a list it is a gradient. Embedded coordinates are independent there.
///
/// | word | meaning |
/// |---|---|
/// | `rot_x(a)`, `rot_y(a)`, `rot_z(a)`, `rot(axis, a)` | rotation matrices, from the axes of a body to those of space: `rot_z(a) * [1, 0, 0]` is `[cos(a), sin(a), 0]`. The axis is proved to have length 1; `n / norm(n)` has |
/// | `body_rate(R)`, `space_rate(R)` | the angular velocity in the axes of the body, and of space; of an angle in the plane its rate |
/// | `velocity_at(p, R, c)` | the velocity of the material point that is at `c`, of a body with the attitude `R` whose point `p` is known |
/// | `kinetic(m, p)` | the kinetic energy of a material point, in space or in the plane |
/// | `kinetic(m, I, p, R)` | the kinetic energy of a rigid body with its centre of mass at `p`: in space `R` is a rotation matrix, `I` a number, a vector (principal moments) or a matrix in the axes of the body; in the plane `R` is an angle and `I` a number. Masses and inertias are expressions of parameters |
///
/// A field marked `#[nh(symmetric)]`, a square matrix, has one parameter for the entries (i, j) and (j, i): that above the
/// diagonal is read, and `validate` compares the two.
///
/// A disk that rolls on the surface z = h(x, y), with its centre in the coordinates `x`, `y`, `z`:
///
/// ```text
/// let R = rot_z(yaw) * rot_x(lean) * rot_y(spin);
/// let centre = [x, y, z];
/// let h(u, v) = k1 * u^2 + k2 * v^2;
/// base { x, y, z, yaw, lean, spin }
/// lagrangian { kinetic(m, [I, J, I], centre, R) - m * g * z }
/// outputs { height = z - h(x, y); slope = diff(h(x, y), [x, y]); rate = der(h(x, y)); }
/// ```
///
/// # Conventions
///
/// - The equations are those of Lagrange and d'Alembert on the Lie algebroid, with p = ∂L/∂y and, where constraints are
///   not linear, the rows of ∂φ/∂y for Φ (Chetaev's rule). The energy is yᵅ ∂L/∂yᵅ − L.
///
///   ```math
///   \frac{d p_\alpha}{dt} + C^\gamma_{\alpha\beta}\, y^\beta p_\gamma - \rho^i_\alpha\,\partial_i L
///     = \Upsilon_\alpha + \lambda_A \Phi^A_\alpha
///   ```
/// - `lhs = rhs` is φ = lhs − rhs. Its multiplier acts as +λ ∂φ/∂y on the right-hand side: for
///   `side = 0` it is the force along `side`.
/// - A force along a coordinate is pulled back by the anchor; along a section it is Υ_α.
/// - `so(3) { w1, w2, w3 }`: [w1, w2] = w3 and cyclic. `se(2) { omega, v1, v2 }`: [omega, v1] = v2,
///   [omega, v2] = −v1. `se(3) { w1, w2, w3, v1, v2, v3 }`: [wᵢ, wⱼ] = ε wₖ, [wᵢ, vⱼ] = ε vₖ. `sl(2)
///   { h, e, f }`: [h, e] = 2e, [h, f] = −2f, [e, f] = h. `heisenberg(n) { x…, y…, z }`: [xᵢ, yᵢ] = z.
///   `so(n)`, n ≥ 4: e_ij = E_ij − E_ji, i < j, in lexicographic order.
///
/// # Units
///
/// `units { x, q[2] = m; theta = rad; m = kg; torque = N m; }` gives units to declared names. Left of `=` stand
/// coordinates, velocities, parameters, constants and inputs, families as a whole or by entry; labels of
/// `constraints` (the unit of the multiplier), `symmetries` (that of the momentum) and `impacts` (that of the impulse),
/// `outputs`, `conserved`, `t` and `lagrangian`. Right of it stand units alone, so `m = kg` is the mass and `x = m` the metre: kg m s A K mol cd rad
/// (= 1) Hz N J W Pa C V F ohm Wb T H, as a product `N m` or `N*m`, with powers `s^-2` and `m^(1/2)`, and one `/`
/// in front of one unit or of parentheses: `m/s^2`, `kg/(m s)`. `1` is that of a pure number. Multiples (mm, g, deg,
/// rpm) are refused, since the equations are in coherent units.
///
/// All other units follow, or stay free: the terms of a sum, both sides of an equation or comparison, and the
/// arguments of `atan2`, `min` and `max` have one unit; arguments of `sin`, `exp` and so on are pure numbers, `der` is
/// per second, L is an energy (`lagrangian = 1`, `t = 1` make a model without units), a force times its velocity is
/// a power, and so is a multiplier times its constraint. 0 has any unit, other numbers have none. In `brackets`,
/// `frame` and `symmetries` names are sections, with the unit of s⁻¹ over that of their velocity. A method of the
/// struct takes and returns whatever its calls agree on. What contradicts something is an error that shows a set
/// of terms of which none can be left out. `REPORT` lists the units, and the documentation of generated fields says them.
///
/// # Symmetries and momenta
///
/// `symmetries { shift: cos(theta) * v1 - sin(theta) * v2; }` declares a section σ, a combination of
/// the quasi-velocities (or of `der(x)` where there is no basis) with coefficients on the base, which
/// may depend on `t`. A section of D (of the kernel of ∂φ/∂y) has a momentum equation,
/// d/dt σᵅp_α = σᶜ(L) + σᵅΥ_α on the constraint manifold; where the right side vanishes the momentum
/// is conserved. Behind `up to` stands a function f on the base: with `fall: der(z) up to -m * g * t`,
/// σᵅp_α − f is the momentum, and σᶜ(L) = df/dt is proved. A section that is not in D has to leave L
/// and D invariant: then the forces of constraint change its momentum. The report tells which of these
/// holds, horizontal symmetries (in D, with L and D invariant) among them.
///
/// `momenta(t, &state)` and `momentum_rates(t, &state, &input)` return a field for each label; with
/// `emit { momenta }` and no `symmetries`, one for each cyclic coordinate whose translation is
/// horizontal.
///
/// # What `emit` can ask for
///
/// Nothing of this costs anything unless it is asked for. Formulas: MATHEMATICS.md of the project.
///
/// | word | methods |
/// |---|---|
/// | `jacobian` | `jacobian(t, &state, &input)`, the trait `Jacobian` |
/// | `sparse_jacobian` | `sparse_jacobian(t, &state, &input)`: its entries that are not always zero, in one array, column by column; the constants `JACOBIAN_ROWS` and `JACOBIAN_COLUMNS` say where they stand, inputs behind the state; `sparse_linearized(t, &state, &input)`: the derivative together with them |
/// | `jacobian_product` | `jacobian_product(t, &state, &input, &direction, &input_direction)`: the Jacobian times a direction, a state and inputs, at the cost of about two derivatives |
/// | `adjoint_product` | `adjoint_product(t, &state, &input, &weights)`: the transpose of the Jacobian times weights of the components of the derivative, by state and by inputs, whatever their number at the cost of a few derivatives |
/// | `output_jacobian` | `output_jacobian(t, &state, &input)`: ∂outputs/∂state and ∂outputs/∂input, the matrices C and D |
/// | `return_jacobian` | `return_jacobian(t, &state)` of the trait `Jacobian`, beside `jacobian` and `holonomic`: the derivative of the return to position constraints, by which steps that end with it are differentiated |
/// | `parameter_jacobian` | `parameter_jacobian(t, &state, &input)`: ∂derivative/∂parameters, a column for each number in the struct's fields, in order |
/// | `angle_cache` | `with_angle_cache()`: a value of the type `AngleCached…`, the same system, which takes sines and cosines from those of angles nearby, with errors of two units in the last place of 1; the struct has to be `Copy` |
/// | `prepared` | `prepare()`: a `Copy` value of the type `Prepared…`, the same system with what depends on parameters alone computed once; the struct has to be `Copy` |
/// | `multipliers`, `reactions` | `multipliers(t, &state, &input)`, `reactions(…)` |
/// | `power` | `power(t, &state, &input)`: the power of each force and of each constraint; the energy changes at the rate of their `total()`, less that at which L depends on the time |
/// | `momenta` | `momenta(t, &state)`, `momentum_rates(t, &state, &input)` |
/// | `gyroscopic` | `gyroscopic(t, &state)` of a Chaplygin system: see *Splitting* |
/// | `splitting` | the nonholonomic connection and the momentum equation: see *Splitting* |
/// | `taylor` | the trait `TaylorSeries`: see *What is generated* |
/// | `gibbs_appell` | `gibbs_appell(t, &state, &input)`: the derivative by the function of Gibbs and Appell, an independent derivation |
/// | `hamiltonian` | the struct `…Phase` of coordinates and momenta π = ∂L/∂v on the constraint distribution; `legendre(t, &state)`, `inverse_legendre(t, &phase)`, `hamiltonian(t, &phase)`, Hamilton's equations `hamilton(t, &phase, &input)`, the matrix `poisson(t, &phase)` of the nonholonomic brackets, and what is not in the bracket with the energy, `drift(t, &phase, &input)` |
/// | `bracket` | `bracket(t, &state, &input)`: the brackets of the `outputs` with each other; `bracket_with_energy(t, &state, &input)` and `drift_of_outputs(t, &state, &input)`, R_L: together the rates of the outputs. Any regular Lagrangian, any constraints, both formulations: declare momenta as outputs where there is no closed `hamiltonian` |
/// | `discrete_gradient` | the trait `AlmostPoisson`, for methods that keep the energy, and position constraints with it; refused, with the reason, where it is not conserved |
/// | `symmetric_projection` | the trait `Holding` for `symmetrically_projected()`: steps of symmetric methods that keep position constraints, and those of the projected formulation |
/// | `invariants` | the trait `Invariants` for `Conserving`: the first integrals of `conserved` and their gradients |
/// | `leapfrog` | the trait `Leapfrog` for `ReflectedLeapfrog`: systems on TQ with constant masses, in the projected formulation |
/// | `rattle` | the trait `DiscreteLagrangian` for `Rattle`: steps that are symplectic on position constraints; systems on TQ with all velocities in the state, without forces and constraints on velocities |
/// | `euler_poincare_suslov` | the trait `EulerPoincareSuslov` for `DiscreteSuslov`: systems on a Lie algebra |
/// | `c` | `C99`, a text: the generated functions as one C file, see *C* |
/// | `latex` | `LATEX`, a text in TeX: the declaration and what was derived in the notation of papers, see *TeX* |
/// | `explain` | `DERIVATION`, a text: which forms competed for each function, and how the winner was proved |
/// | `divergence` | `divergence(t, &state, &input)` of the motion in the coordinates of the state |
/// | `volume` | `volume_density(t, &state)` of a volume that the motion keeps; refused, with the modular section, where there is none with a density on the base. Beside `holonomic` it is kept where the position constraints hold, divided by their differentials, and `divergence` belongs to the same volume |
/// | `connection` | `connection(t, &state)`, the symbols of the constrained connection, and `christoffel(t, &state)` of the kinetic metric without constraints |
///
/// `hamilton_jacobi { … }` gives `hamilton_jacobi(t, &state)`: the state over the same point of the base
/// with these momenta.
/// `routh { spin = mu; }` puts the momentum of a symmetry (or of a cyclic coordinate, by its name) on
/// the level `mu`, an expression of parameters. It has to be conserved, with its section in D. The
/// state loses a velocity, and a cyclic coordinate that the section moves; `velocity` gives the first
/// back, and `quadratures(t, &state)` the rate of the second, for a quadrature. Which velocity is chosen
/// as for constraints: its pivot vanishes nowhere, or is of parameters, or `independent` names the velocities that
/// are left, and the report says where they break down. Where the level determines none everywhere, as
/// x ẏ − y ẋ in a plane, and in the projected formulation, the state keeps all velocities: the motion keeps
/// the level, which `constraint_residual` and `project` know of.
///
/// # Splitting
///
/// V is the kernel of the anchor; where that is 0, the directions of the symmetry group, generated by
/// the declared `symmetries` that leave L and D invariant, with the cyclic coordinates that these move,
/// or, where none are declared, by all cyclic coordinates. (The coordinates that the group moves are
/// left out below, in a frame that commutes with it; where none is found, or the coordinates do not separate
/// its orbits, that is said and no other group is taken.) Over an embedded base – a sphere, a circle – every
/// coordinate has its lift, over the tangent part of its unit rate, and the equations hold in all of them. The report says what reduction theory
/// calls the system (CM section 4.2), and shows the quantities of small ones.
///
/// - D ∩ V = 0 and every rate of the coordinates occurs in D: a Chaplygin system. `emit { gyroscopic }`
///   gives `gyroscopic(t, &state)`, the force ⟨J, K⟩ on the right of the Euler–Lagrange equations of the
///   reduced Lagrangian.
/// - In general `emit { splitting }` gives, all at `(t, &state)` and those that are not empty:
///   `vertical_sections`, a basis S of D ∩ V; `horizontal_lifts` h of unit rates to D, orthogonal to S in
///   the kinetic metric, for the coordinates that the report names; `locked_inertia` ⟨S, S⟩ (where the metric
///   depends on the time or on velocities there is none, and h are any such lifts);
///   `connection_coefficients`, the brackets [h, S] as `[κ][ρ]`; `curvature`, the brackets [h, h];
///   `vertical_momenta` p(S) and their rates `vertical_momentum_rates(t, &state, &input)`, the momentum
///   equation; `vertical_velocities`, the components along S; `horizontal_force`, what curvature and
///   connection add to the horizontal equations. Sections are arrays of components along the basis.
///   MATHEMATICS.md (25), CM Propositions 8 and 9.
///
/// # C
///
/// `emit { c }` gives `C99: &str`, a C99 file that needs nothing but libm: for `struct Skate` the struct `Skate` of
/// parameters, `SkateState` and `SkateInput` with the same fields, and a function for the derivative, each function of
/// the default set and each that is asked for (those with time, state and input for arguments),
/// `void skate_derivative(const Skate *p, double t, const SkateState *x, const SkateInput *u, SkateState *rate)` and
/// `void skate_energy(const Skate *p, double t, const SkateState *x, double result[1])`; components are in the order
/// of the Rust struct, matrices row by row, the Jacobian a row of ∂/∂state and ∂/∂input after the other. Methods of
/// the struct that forces call are `extern` prototypes, `double skate_motor(const Skate *p, double x0)`. `f32` gives
/// `float`; a struct with a type parameter is refused. The arithmetic is that of the Rust functions in the same order,
/// with libm's functions for ours. No memory is allocated, nothing recurs, and no branch but those of `sign`, `min`,
/// `max` and pivoting depends on a number. Write it from a build script or a program:
/// `std::fs::write("skate.c", Skate::C99)`.
///
/// # TeX
///
/// `emit { latex }` gives `LATEX: &str`: variables with their units, anchor, brackets, Lagrangian, constraints, forces, what
/// kind of system it is, D, mass matrix, equations of motion, symmetries and what is conserved. One text serves two uses:
/// written to a file by `std::fs::write("skate.tex", Skate::LATEX)` it is a document that `pdflatex` compiles, and in
/// another document that loads amsmath `\input{skate}` puts its text there. It needs amsmath alone. Names of Greek letters are
/// letters, what follows `_` and indices stand below, `x_dot` has a dot: `theta_1` is θ₁, `phi_dot[2]` is φ̇₂. Expressions
/// that would fill pages end with dots.
///
/// # How accurate the emitted code is
///
/// `accuracy { fast }` takes whatever form has the fewest operations; sines and cosines of sums of angles
/// come from those of the parts where that saves evaluations, which costs small angles their relative
/// accuracy. `balanced`, the default, takes a cheaper form unless its rounding error may be more than four
/// times as large. `careful` takes forms that lose nothing, and carries the rounding error of every sum,
/// product and quotient along to first order: results are as if computed with nearly twice the digits and
/// rounded once, if the target has fused multiply-adds, for some 1.5 to 5 times the instructions. What of
/// each system and level comes out is in BENCHMARKS.md of the project.
///
/// # Which velocities the state keeps
///
/// In the adapted formulation each constraint eliminates a velocity. One written `name = …` or
/// `der(x) = …`, solved for that velocity, eliminates it; otherwise the macro looks for velocities
/// whose pivot vanishes nowhere that the constraints are independent. A pivot of parameters alone
/// counts, and `validate` refuses its zero. Where there is no such choice (a knife edge in `x`, `y`,
/// `theta`) the state keeps all velocities: the projected formulation. A choice by `independent` is
/// taken even if its pivot vanishes somewhere; the report says where.
///
/// Beside `holonomic` and `on` the list may name coordinates, too: as many as the equations leave free, which determine
/// the others wherever the derivatives of the equations by these are invertible. The state keeps all coordinates; those
/// that are named are what `linearization { }` keeps, with the velocities.
///
/// # What is generated
///
/// For `struct Skate`:
///
/// - `SkateState`, with one field per name, base coordinates first, then velocities; `SkateVelocity`
///   with all quasi-velocities; `SkateInput`, `SkateOutputs`, `SkateMultipliers`, `SkateMomenta`,
///   `SkateQuadratures` where there are any.
///   All are `Copy`, `Default`, `Debug`, `PartialEq`, and convert to and from arrays and
///   `nalgebra::SVector`. The velocity of `x` where there is no basis is the field `x_dot`.
/// - The traits `Dynamics`, `Energy`, and `Observed`, `Jacobian`, `Constrained` where they apply.
/// - Methods, all with the time first: `derivative(t, &state, &input)`, `energy(t, &state)`,
///   `velocity(t, &state)`, `outputs(t, &state, &input)`; on request `multipliers`, `reactions` and
///   `jacobian(t, &state, &input)`; in the projected formulation `constraint_residual(t, &state)` and
///   `project(t, &mut state)`; with `on`, `normalize(&mut state)`.
/// - On request `taylor`: the recurrences of the Taylor coefficients of solutions, the trait
///   `TaylorSeries`, for the method `Taylor`; and `taylor::<P>(t, &state, &input)`, the first `P`
///   coefficients. Forces have to be analytic in the state and the time: no `abs`, `sign`, `min`, `max`
///   or method of the struct whose arguments change during a step.
/// - `validate(&self)`: parameters that are not finite, that break an assumption, or that make a
///   divisor of the equations zero.
/// - `const REPORT: &str`: the classification, the structure functions, the distribution, the mass
///   matrix, the equations, what is conserved, operation counts. The equations also stand in the
///   documentation of the struct.
///
/// A field that stands in no expression is listed in `REPORT`, and nothing generated reads it: where no code of
/// yours reads it either, the compiler's own lint `dead_code` says so at the field. An underscore before its name, or
/// `#[allow(dead_code)]`, says that this is meant.
///
/// The fields are of one scalar type: `f64`, `f32`, or a type parameter, `struct Skate<T> { m: T }`,
/// for which the generated code is generic over the runtime's `Scalar`.
#[proc_macro_attribute]
pub fn nonholonomic(
    attribute: proc_macro::TokenStream,
    item: proc_macro::TokenStream,
) -> proc_macro::TokenStream {
    expand::nonholonomic(attribute.into(), item.into()).into()
}

/// Proves that a map between two declared systems carries the motion of one to that of the other.
///
/// `Full` and `Reduced` are structs with `#[nonholonomic]`; the map is a map of vector bundles over a
/// map of the bases, written in the names of `Full`:
///
/// ```text
/// morphism! { SleighOnThePlane -> Sleigh {
///     parameters { J = J; m = m; }
///     base       { theta = theta; x = x; y = y; }
///     velocities {
///         omega = der(theta);
///         v1 = cos(theta) * der(x) + sin(theta) * der(y);
///         v2 = -sin(theta) * der(x) + cos(theta) * der(y);
///     }
///     inputs     { torque = torque; }
/// } }
/// ```
///
/// What has the same name in both systems may be left out, and so may the sections; where `Reduced`
/// has no basis of its own, so may all its velocities. Families are given as in declarations,
/// `w[0] = …;`, `w[i in 0..3] = …;` or as a vector. `crate { ::path }` names the runtime where the
/// dependency is renamed. A system is named by a path to its module, `models::Sleigh`, or is in scope
/// with everything generated for it (`use models::*;`).
///
/// Proved is, or refused with the expression that should have been zero:
///
/// - the map is admissible and a morphism of brackets (CLMM 2.3), and onto on every fibre;
/// - L = L' after the map; D goes onto D', for linear, affine and nonlinear constraints;
/// - the forces do the same work on every velocity that the constraints allow.
///
/// Either system may have position constraints that do not depend on the time. Then all of this is asked where those
/// of `Full` hold, for velocities that are tangent to them, and those of `Reduced` have to hold there after the map.
///
/// Then motions go to motions (CLMM Theorems 4.6 and 7.8), and the macro implements
/// `Reduction<Reduced> for Full`. Where the velocities of `Reduced` determine those of `Full` it also
/// implements `Reconstruction<Reduced> for Full`: the dropped coordinates follow from the reduced
/// motion.
#[proc_macro]
pub fn morphism(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    morphism::morphism(input.into()).into()
}

/// Constructs the quotient of a declared system by a symmetry: a declared system of its own.
///
/// ```text
/// quotient! {
///     SleighOnThePlane ->
///     /// The sleigh on se(2).
///     #[derive(Clone, Copy, Debug)]
///     pub struct Sleigh by { theta, x, y } {
///         velocities {
///             omega = der(theta);
///             v1 = cos(theta) * der(x) + sin(theta) * der(y);
///             v2 = cos(theta) * der(y) - sin(theta) * der(x);
///         }
///         emit { multipliers }
///     }
/// }
/// ```
///
/// The coordinates listed behind `by` are those along the group, and the quasi-velocities belong to
/// an invariant frame: as many as there are sections. Without them the frame is that of the full
/// system, for coordinates that are cyclic in it; or it is derived, so that it commutes with the
/// `symmetries` of the full system, for coordinates that these move: a velocity `x_dot` that is not
/// invariant gives way to `body_x`. In the frame nothing may depend on the dropped
/// coordinates – the anchor on the rest of the base, the brackets, L, D, the forces – which is proved,
/// or refused with the derivative that should have been zero. Constraints that are not invariant
/// themselves, though what they allow is, are solved for velocities. Of an embedded family a part may be dropped
/// – two rows of a rotation matrix –: on the embedded base everything is rewritten in the coordinates that are
/// left, with the identities that these satisfy. Position constraints are passed on: their functions have to be
/// invariant, as everything else, on all of the base, and may not depend on the time.
///
/// The macro emits the struct, with the parameters of the full system as public fields, its
/// declaration by `#[nonholonomic]` (read it in `Sleigh::REPORT`), and `morphism!` between the two, so
/// that `Reduction` and `Reconstruction` are there. Other sections in the last braces, `emit`, `on`,
/// `outputs`, `conserved` and so on, are passed on to the new declaration; `crate { ::path }` names the
/// runtime where the dependency is renamed. A row or an entry of a family that is kept alone is called
/// `R_2_0`. CM section 4, CLMM 4.8–4.12.
#[proc_macro]
pub fn quotient(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    quotient::quotient(input.into()).into()
}
