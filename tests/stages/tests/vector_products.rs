//! What derivatives of the motion cost beside the motion: a law over the reference systems and the machines of the
//! benchmark of record.

use nh_stages::{Declaration, arms, bicycle, record, references};
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::program::{Cost, schedule_grouping};
use nonholonomic_core::system::{Side, System};

/// The catalogue and the record, with both products and the Jacobian asked for.
fn systems() -> Vec<(String, System)> {
    let catalogue = references().into_iter();
    catalogue.chain(record()).filter_map(|(name, declaration)| Some((name, derived(declaration)?))).collect()
}

fn derived(mut declaration: Declaration) -> Option<System> {
    let words = "jacobian, jacobian_product, adjoint_product";
    let text = declaration.attribute.to_string();
    let text = match text.split_once("emit {") {
        // what else is asked for is not looked at here
        Some((before, rest)) => {
            let (_, after) = rest.split_once('}')?;
            format!("{before} emit {{ {words} }} {after}")
        }
        None => format!("{text} emit {{ {words} }}"),
    };
    declaration.attribute = text.parse().ok()?;
    // macros that are no declarations by themselves
    declaration.system().ok()
}

/// Instructions, roughly: those of the operations, and one to store each component that is not always 0.
fn cost(system: &System, procedure: &Procedure) -> f64 {
    let parameters: Vec<_> = system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &system.model.graph;
    let stored = procedure.outputs.iter().filter(|output| !graph.is_literal_zero(**output)).count();
    let instructions = Cost::of(&schedule_grouping(graph, procedure, &parameters)).instructions() + stored;
    f64::from(u32::try_from(instructions).expect("a small number"))
}

#[test]
fn products_with_vectors_cost_a_few_derivatives() {
    let systems = systems();
    assert!(systems.len() >= 40, "{}", systems.len());
    let mut worst = [(0.0_f64, String::new()), (0.0, String::new())];
    println!("in evaluations of the derivative:");
    for (name, system) in &systems {
        let derivative = cost(system, &system.derivative);
        for product in &system.products {
            let ratio = cost(system, &product.procedure) / derivative;
            println!("{name:28} {:18} {ratio:.2}", product.side.word());
            let slot = &mut worst[usize::from(product.side == Side::Left)];
            if ratio > slot.0 {
                *slot = (ratio, name.clone());
            }
        }
    }
    println!("{worst:?}");
    assert!(worst[0].0 <= 2.5, "{worst:?}");
    assert!(worst[1].0 <= 4.0, "{worst:?}");
}

/// A matrix has as many columns as the state has variables, most of which share their work. The worst is where the
/// derivative is shortest for what it is: halves and doubles that went into its sums made it 2 % shorter, and the matrix not.
#[test]
fn jacobians_of_few_velocities_cost_a_few_derivatives() {
    let mut worst = (0.0_f64, String::new());
    for (name, system) in systems().iter().filter(|(_, system)| system.state_velocities.len() <= 4) {
        let jacobian = &system.jacobian().expect("it was asked for");
        let ratio = cost(system, jacobian) / cost(system, &system.derivative);
        println!("{name:28} {ratio:.2}");
        if ratio > worst.0 {
            worst = (ratio, name.clone());
        }
    }
    println!("{worst:?}");
    assert!(worst.0 <= 4.26, "{worst:?}");
}

/// Of a chain, whose bodies are solved from the last to the first: what solved them solves for derivatives as well, and
/// a Jacobian takes a number of operations that grows like that of its entries.
#[test]
fn chains_are_differentiated_with_what_solved_them() {
    let mut costs = Vec::new();
    for links in [4, 8] {
        let (name, declaration) = arms()
            .into_iter()
            .find(|(name, _)| *name == format!("arm on a skate, {links} links"))
            .expect("it is among the arms");
        let system = derived(declaration).expect("an arm");
        for site in ["jacobian", "jacobian_product", "adjoint_product"] {
            let chosen = system.ledger.at(site).and_then(|decision| decision.chosen());
            let form = chosen.expect("it is proved").form;
            assert_eq!(form, "differentiated step by step, with the factors of C", "{name}, {site}");
        }
        costs.push(cost(&system, &system.jacobian().expect("it was asked for")));
    }
    println!("{costs:?}");
    assert!(costs[1] <= 4.0 * costs[0], "{costs:?}");
    assert!(costs[0] <= 1600.0, "{costs:?}");
}

/// That of the benchmark bicycle as well, of ten thousand operations.
#[test]
fn long_jacobians_are_proved() {
    let system = bicycle("emit { jacobian }").system().expect("a bicycle");
    let decision = system.ledger.at("jacobian").expect("it was asked for");
    assert!(decision.chosen().is_some(), "{}", system.ledger);
}

/// Every product was proved, and so was every Jacobian.
#[test]
fn all_of_them_are_proved() {
    for (name, system) in systems() {
        for site in ["jacobian", "jacobian_product", "adjoint_product"] {
            let decision = system.ledger.at(site).expect("it was asked for");
            assert!(decision.chosen().is_some(), "{name}, {site}: {}", system.ledger);
        }
    }
}
