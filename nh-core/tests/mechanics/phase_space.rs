//! Brackets, the Hamiltonian side, volume and connections, against the Lagrangian side.

use crate::systems::{self, Builder, origin};

use nonholonomic_core::algebra::Graph;
use nonholonomic_core::compile::compile;
use nonholonomic_core::functions;
use nonholonomic_core::id::{ExprId, Id, SymbolId};
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::model::{Located, Model, OutputDecl, Request, SectionClaim, VolumeClaim};
use nonholonomic_core::program::{interpret, schedule};
use nonholonomic_core::system::System;
use nonholonomic_core::violation::{Law, Violation};

fn asking(mut model: Model, requests: &[Request]) -> Model {
    model.requests.extend(requests.iter().map(|request| (*request, origin())));
    model
}

fn compiled(model: Model) -> System {
    compile(model).unwrap_or_else(|violations| panic!("{violations:#?}"))
}

fn refused(model: Model) -> Vec<Violation> {
    compile(model).err().unwrap_or_else(|| panic!("this should not compile"))
}

/// A value for every symbol.
fn sample(symbol: SymbolId) -> f64 {
    0.4 + f64::from(u8::try_from((symbol.index() * 7919) % 13).unwrap()) / 11.0
}

fn values(graph: &Graph, procedure: &Procedure, lookup: impl Fn(SymbolId) -> f64) -> Vec<f64> {
    interpret(&schedule(graph, procedure), lookup)
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * (1.0 + expected.abs()), "{found} is not {expected}");
}

/// The systems whose energy is conserved, in both formulations.
fn conservative() -> Vec<Model> {
    vec![
        systems::sleigh(),
        systems::sleigh_on_the_plane(),
        systems::robot(),
        systems::veselova(),
        systems::snakeboard(false),
        systems::snakeboard(true),
        systems::charged_particle(true),
        systems::charged_particle(false),
        systems::parallel_velocities(),
    ]
}

#[test]
fn the_almost_poisson_form_is_the_equations() {
    for model in conservative() {
        let system = compiled(asking(model, &[Request::DiscreteGradient]));
        let form = system.phase_space.almost_poisson.as_ref().unwrap();
        let graph = &system.model.graph;
        // at a point of the constraint manifold: an embedded base and nonlinear constraints are met exactly
        let on_manifold = manifold_point(&system);
        let at = |symbol: SymbolId| {
            on_manifold.iter().find(|(s, _)| *s == symbol).map_or(sample(symbol), |(_, v)| *v)
        };
        let expected = values(graph, &system.derivative, at);
        let gradient = values(graph, &form.gradient, at);
        let program = schedule(graph, &form.sharp);
        let sharp = |covector: &[f64]| {
            interpret(&program, |symbol| {
                form.covector
                    .iter()
                    .position(|c| *c == symbol)
                    .map_or_else(|| at(symbol), |index| covector[index])
            })
        };
        for (found, expected) in sharp(&gradient).iter().zip(&expected) {
            close(*found, *expected);
        }
        // antisymmetric, on and off the constraint manifold
        let n = gradient.len();
        for i in 0..n {
            for j in 0..n {
                let unit = |k: usize| (0..n).map(|l| if l == k { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
                close(sharp(&unit(j))[i], -sharp(&unit(i))[j]);
            }
        }
    }
}

/// Velocities that satisfy the constraints of a projected system, by Newton's iteration for the last ones.
fn manifold_point(system: &System) -> Vec<(SymbolId, f64)> {
    let Some(projection) = &system.projection else { return Vec::new() };
    let graph = &system.model.graph;
    let mut point: Vec<(SymbolId, f64)> = system.state_velocities.iter().map(|v| (*v, sample(*v))).collect();
    for _ in 0..50 {
        let lookup = |symbol: SymbolId| {
            let started = projection.start.iter().position(|s| *s == symbol);
            let name = started.map_or(symbol, |index| system.state_velocities[index]);
            match started {
                Some(_) => sample(name),
                None => point.iter().find(|(s, _)| *s == symbol).map_or(sample(symbol), |(_, v)| *v),
            }
        };
        let next = values(graph, &projection.step, lookup);
        point = system.state_velocities.iter().copied().zip(next).collect();
    }
    point
}

#[test]
fn the_hamiltonian_side_is_the_lagrangian_side() {
    let mut models =
        vec![systems::ball_on_rotating_table(), systems::steered_blade(), systems::time_dependent_form()];
    models.extend([
        systems::sleigh(),
        systems::robot(),
        systems::snakeboard(true),
        systems::charged_particle(false),
    ]);
    for mut model in models {
        if model.constraints.len() == 3 {
            // the robot on the plane: a choice of velocities
            let keep = ["psi1_dot", "psi2_dot"];
            let symbols = model.graph.symbols();
            let named = |name: &str| symbols.ids().find(|id| symbols[*id] == name).unwrap();
            model.independent = Some(keep.map(|name| (named(name), origin())).to_vec());
        }
        let mut system = compiled(asking(model, &[Request::Hamiltonian]));
        let side = system.phase_space.hamiltonian.clone().unwrap();
        let graph = &mut system.model.graph;
        let coordinates: Vec<SymbolId> = system.model.coordinates.iter().map(|c| c.symbol).collect();
        let n = coordinates.len();
        let momenta = values(graph, &side.legendre, sample);
        let at = |symbol: SymbolId| {
            side.momenta.iter().position(|p| *p == symbol).map_or_else(|| sample(symbol), |a| momenta[a])
        };
        // 1. the inverse, and h = E_L
        for (found, velocity) in values(graph, &side.inverse, at).iter().zip(&system.state_velocities) {
            close(*found, sample(*velocity));
        }
        close(
            values(graph, &side.hamiltonian, at)[0],
            values(graph, system.functions.get(&functions::ENERGY).unwrap(), sample)[0],
        );
        // 2. Hamilton's equations are the derivative, carried over: π̇ = ∂π/∂(t, x, v) · (1, ẋ, v̇)
        let rates = values(graph, &system.derivative, sample);
        let found = values(graph, &side.equations, at);
        let state: Vec<SymbolId> = coordinates.iter().chain(&system.state_velocities).copied().collect();
        for (i, expected) in rates.iter().take(n).enumerate() {
            close(found[i], *expected);
        }
        for (a, momentum) in side.legendre.outputs.clone().into_iter().enumerate() {
            let mut slopes: Vec<ExprId> =
                state.iter().map(|symbol| graph.partial(momentum, *symbol)).collect();
            slopes.push(graph.partial(momentum, system.model.time));
            let slopes = graph.evaluate(&slopes, sample);
            let carried: f64 = slopes.iter().zip(rates.iter().chain(&[1.0])).map(|(s, r)| s.value * r).sum();
            close(found[n + a], carried);
        }
        // 3. (16): without drift and time, ż = {z, h}, and R_L = 0
        let is_affine = system.report.contains("affine") || system.report.contains("moving energy");
        let equations = side.equations.written_out(graph);
        let depends_on_time = graph.depends_on(system.model.lagrangian.value, &[system.model.time])
            || graph.symbols_in(&equations).contains(&system.model.time);
        if is_affine || depends_on_time {
            continue;
        }
        assert!(side.drift.outputs.iter().all(|rest| graph.is_literal_zero(*rest)));
        let energy = side.hamiltonian.written_out(graph)[0];
        let phase: Vec<SymbolId> = coordinates.iter().chain(&side.momenta).copied().collect();
        let slopes: Vec<ExprId> = phase.iter().map(|symbol| graph.partial(energy, *symbol)).collect();
        let slopes: Vec<f64> = graph.evaluate(&slopes, at).iter().map(|b| b.value).collect();
        let bracket = values(graph, &side.bracket, at);
        for (row, expected) in bracket.chunks(phase.len()).zip(&found) {
            close(row.iter().zip(&slopes).map(|(p, s)| p * s).sum(), *expected);
        }
    }
}

/// CLMM (7.8): π₁ = r ẋ + k² ω₂, π₂ = r ẏ − k² ω₁, π₃ = k² ω₃, π₄ = ẋ − r ω₂, π₅ = ẏ + r ω₁.
#[test]
fn the_brackets_of_the_ball_on_the_rotating_table() {
    let mut b = Builder { model: asking(systems::ball_on_rotating_table(), &[Request::Bracket]) };
    let functions: [&[(i64, i64, &str)]; 5] = [
        &[(1, 1, "x")],
        &[(1, 1, "y")],
        &[(1, 1, "r*dx"), (1, 1, "k2*w2")],
        &[(1, 1, "r*dy"), (-1, 1, "k2*w1")],
        &[(1, 1, "k2*w3")],
    ];
    for (index, terms) in functions.iter().enumerate() {
        let value = b.sum(terms);
        b.model.outputs.push(OutputDecl { name: format!("f{index}"), value, origin: origin() });
    }
    let system = compiled(b.model);
    let bracket = system.functions.get(&functions::BRACKET).unwrap();
    let found = values(&system.model.graph, bracket, sample);
    let named = |name: &str| {
        let symbols = system.model.graph.symbols();
        sample(symbols.ids().find(|id| symbols[*id] == name).unwrap())
    };
    let (r, k2, w3, omega) = (named("r"), named("k2"), named("w3"), named("Omega"));
    let (x, y, w1, w2) = (named("x"), named("y"), named("w1"), named("w2"));
    let velocities: Vec<String> =
        system.state_velocities.iter().map(|v| system.model.graph.symbols()[*v].clone()).collect();
    let (dx, dy) = if velocities.iter().any(|name| name == "dx") {
        (named("dx"), named("dy"))
    } else {
        (r * w2 - omega * y, -r * w1 + omega * x)
    };
    let (pi1, pi2) = (r * dx + k2 * (dx + omega * y) / r, r * dy + k2 * (dy - omega * x) / r);
    let pi3 = k2 * w3;
    let at = |i: usize, j: usize| found[5 * i + j];
    // {x, π₁} = {y, π₂} = r
    close(at(0, 2), r);
    close(at(1, 3), r);
    for (i, j) in [(0, 1), (0, 3), (0, 4), (1, 2), (1, 4)] {
        close(at(i, j), 0.0);
    }
    // {π₁, π₂} = π₃, {π₂, π₃} = k²/(k² + r²) π₁ + rk²Ω/(k² + r²) y, {π₃, π₁} = k²/(k² + r²) π₂ − rk²Ω/(k² + r²) x
    let s = k2 / (k2 + r * r);
    close(at(2, 3), pi3);
    close(at(3, 4), s * pi1 + r * s * omega * y);
    close(at(4, 2), s * pi2 - r * s * omega * x);
}

/// CLMM section 7.4, with the terms along π that hold (mathematics, where the papers differ):
/// R_L = k²Ω/(k²+r²) (x ∂_y − y ∂_x) − rΩ/(k²+r²) (π₃ − k²Ω)(x ∂_π₁ + y ∂_π₂)
///       + rk²Ω/(k²+r²)² (π₁x + π₂y) ∂_π₃.
#[test]
fn the_drift_of_the_ball_on_the_rotating_table() {
    let mut b = Builder { model: asking(systems::ball_on_rotating_table(), &[Request::Hamiltonian]) };
    let functions = [
        b.sum(&[(1, 1, "x")]),
        b.sum(&[(1, 1, "y")]),
        b.sum(&[(1, 1, "r*dx"), (1, 1, "k2*w2")]),
        b.sum(&[(1, 1, "r*dy"), (-1, 1, "k2*w1")]),
        b.sum(&[(1, 1, "k2*w3")]),
    ];
    let system = compiled(b.model);
    assert!(system.report.contains("R_L("), "{}", system.report);
    let side = system.phase_space.hamiltonian.as_ref().unwrap();
    let graph = &system.model.graph;
    let coordinates: Vec<SymbolId> = system.model.coordinates.iter().map(|c| c.symbol).collect();
    let phase: Vec<SymbolId> = coordinates.iter().chain(&side.momenta).copied().collect();
    let at = |point: &[f64], symbol: SymbolId| {
        phase.iter().position(|known| *known == symbol).map_or_else(|| sample(symbol), |index| point[index])
    };
    // the functions at a point of phase space, all velocities from the momenta
    let velocity = system.functions.get(&functions::VELOCITY).unwrap();
    let evaluated = |point: &[f64]| -> Vec<f64> {
        let kept = values(graph, &side.inverse, |symbol| at(point, symbol));
        let of_state = |symbol: SymbolId| {
            let index = system.state_velocities.iter().position(|known| *known == symbol);
            index.map_or_else(|| at(point, symbol), |index| kept[index])
        };
        let all = values(graph, velocity, of_state);
        let symbols: Vec<SymbolId> = system.model.sections.iter().map(|section| section.symbol).collect();
        let lookup = |symbol: SymbolId| {
            symbols
                .iter()
                .position(|known| *known == symbol)
                .map_or_else(|| at(point, symbol), |index| all[index])
        };
        graph.evaluate(&functions, lookup).iter().map(|bounded| bounded.value).collect()
    };
    let here: Vec<f64> = phase.iter().map(|symbol| sample(*symbol)).collect();
    let drift = values(graph, &side.drift, |symbol| at(&here, symbol));
    // the functions are quadratic at most: a central difference is exact
    let moved = |by: f64| evaluated(&here.iter().zip(&drift).map(|(z, r)| z + by * r).collect::<Vec<_>>());
    let found: Vec<f64> = moved(1.0).iter().zip(moved(-1.0)).map(|(a, b)| (a - b) / 2.0).collect();
    let named = |name: &str| {
        let symbols = graph.symbols();
        sample(symbols.ids().find(|id| symbols[*id] == name).unwrap())
    };
    let (r, k2, omega, x, y) = (named("r"), named("k2"), named("Omega"), named("x"), named("y"));
    let [_, _, pi1, pi2, pi3] = evaluated(&here)[..] else { panic!("five functions") };
    let sum = k2 + r * r;
    close(found[0], -k2 * omega / sum * y);
    close(found[1], k2 * omega / sum * x);
    close(found[2], -r * omega / sum * (pi3 - k2 * omega) * x);
    close(found[3], -r * omega / sum * (pi3 - k2 * omega) * y);
    close(found[4], r * k2 * omega / (sum * sum) * (pi1 * x + pi2 * y));
}

fn claiming(mut model: Model) -> Model {
    model.volume = Some(VolumeClaim { density: None, origin: origin() });
    asking(model, &[Request::Volume, Request::Divergence])
}

fn with_zero(mut model: Model, name: &str) -> Model {
    let mut b = Builder { model };
    let symbol = b.symbol(name);
    let value = b.model.lagrangian.value;
    b.model.lagrangian.value = b.model.graph.at_zero(value, &[symbol]);
    model = b.model;
    model
}

#[test]
fn the_sleigh_keeps_a_volume_iff_a_is_zero() {
    for make in [systems::sleigh, systems::sleigh_on_the_plane] {
        let violations = refused(claiming(make()));
        assert_eq!(violations.iter().map(|v| v.law).collect::<Vec<_>>(), [Law::Volume]);
        assert!(violations[0].evidence.contains("modular section"), "{violations:?}");
        let system = compiled(claiming(with_zero(make(), "a")));
        assert!(system.report.contains("invariant: "), "{}", system.report);
    }
}

#[test]
fn veselova_keeps_the_known_volume() {
    let system = compiled(claiming(systems::veselova()));
    let graph = &system.model.graph;
    let density = system.functions.get(&functions::VOLUME_DENSITY).unwrap();
    // on |γ| = 1 proportional to √⟨γ, I⁻¹γ⟩
    let lookup = |seed: f64| {
        let mut g = [0.3 + seed, -0.5 * seed, 0.9 - 0.2 * seed];
        let norm = g.iter().map(|x| x * x).sum::<f64>().sqrt();
        for x in &mut g {
            *x /= norm;
        }
        g
    };
    let inertia = [1.3, 0.8, 2.1];
    let mut ratios = Vec::new();
    for seed in [0.1, 0.7, 1.9] {
        let g = lookup(seed);
        let value = values(graph, density, |symbol| {
            let name = &graph.symbols()[symbol];
            let index = usize::from(name.as_bytes()[1] - b'1');
            if name.starts_with('g') { g[index] } else { inertia[index] }
        })[0];
        let expected = (0..3).map(|i| g[i] * g[i] / inertia[i]).sum::<f64>().sqrt();
        ratios.push(value / expected);
    }
    close(ratios[1] / ratios[0], 1.0);
    close(ratios[2] / ratios[0], 1.0);
}

#[test]
fn the_geodesic_form_is_the_equations() {
    for model in
        [systems::sleigh(), systems::veselova(), systems::sleigh_on_the_plane(), systems::snakeboard(true)]
    {
        let system = compiled(asking(model, &[Request::Connection]));
        let graph = &system.model.graph;
        let point = manifold_point(&system);
        let at =
            |symbol: SymbolId| point.iter().find(|(s, _)| *s == symbol).map_or(sample(symbol), |(_, v)| *v);
        let symbols = values(graph, system.functions.get(&functions::CONNECTION).unwrap(), at);
        let velocity: Vec<f64> = system.state_velocities.iter().map(|v| at(*v)).collect();
        let derivative = values(graph, &system.derivative, at);
        let r = velocity.len();
        for c in 0..r {
            let turned: f64 =
                (0..r * r).map(|ab| symbols[ab * r + c] * velocity[ab / r] * velocity[ab % r]).sum();
            close(derivative[derivative.len() - r + c], -turned);
        }
    }
}

/// A free particle with dz = y dx: α = (1, 0), constant momenta along x.
#[test]
fn a_section_that_solves_the_hamilton_jacobi_equation() {
    let claimed = |along_x: &[(i64, i64, &str)]| {
        let mut b = Builder::new(&["k"], &["x", "y", "z"], &["u", "v"]);
        b.anchor(&[&[(1, 1, "u")], &[(1, 1, "v")], &[]]);
        b.lagrangian(&[(1, 2, "u*u"), (1, 2, "v*v")]);
        b.model.brackets_declared = true;
        let value = b.sum(along_x);
        let u = b.symbol("u");
        b.model.hamilton_jacobi = Some(SectionClaim {
            components: vec![(u, Located { value, origin: origin() })],
            origin: origin(),
        });
        b.model
    };
    let system = compiled(claimed(&[(1, 1, "k")]));
    assert_eq!(system.functions.get(&functions::HAMILTON_JACOBI).unwrap().outputs.len(), 2);
    for wrong in ["x", "y"] {
        let violations = refused(claimed(&[(1, 1, wrong)]));
        assert_eq!(violations.iter().map(|v| v.law).collect::<Vec<_>>(), [Law::HamiltonJacobi]);
    }
}
