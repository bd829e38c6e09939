//! Bodies in space that joints connect: their equations in their own axes, mathematics (42), (43).
//!
//! The bodies that a declaration names are frames that carry each other (`tree.rs`). Angular velocities and
//! accelerations go from frame to frame, each in its own axes, by relative poses (`motion.rs`), what forces they take comes
//! back (`inertia.rs`). Velocities of which each moves one joint alone are eliminated there: what is left is the
//! articulated inertia, so that a further body of a chain costs a constant. The velocities of all other frames have a
//! mass matrix, by the inertias of all that these carry.

mod free_turn;
mod hinges;
mod inertia;
mod motion;
mod other_axes;
mod sheet;
mod tree;
mod turning;
mod weight;

pub use free_turn::where_attitude_is_one;
pub use other_axes::OtherAxes;

use super::adapted::reduced_equations;
use super::body::Body;
use super::euler_lagrange::LagrangianSystem;
use super::procedure::Procedure;
use super::symmetric_solve::{Definiteness, solve_symmetric};
use crate::algebra::{Graph, Matrix};
use crate::geometry::ConstraintDistribution;
use crate::id::ExprId;
use inertia::{Inertia, Twist, acceleration_carried, force_carried, power};
use motion::{Motion, balance, motions};
use sheet::Sheet;
use tree::Tree;
use weight::Fall;

/// Which velocities are eliminated joint by joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Elimination {
    /// None: they have a mass matrix.
    Nowhere,
    /// All that move one joint alone.
    Everywhere,
}

/// ẋ and v̇ of bodies in space; `None` where they are not declared as such.
///
/// Pivots are those of C in another order, along the axes that are returned: for C that is definite.
pub fn accelerations_of_joints(
    graph: &mut Graph,
    (system, bodies): (&LagrangianSystem, &[Body]),
    distribution: &ConstraintDistribution,
    elimination: Elimination,
) -> Option<(Procedure, Vec<OtherAxes>)> {
    let independent = distribution.independent.len();
    if bodies.len() < 2 || !distribution.eliminated.is_empty() {
        return None;
    }
    let mut sheet = Sheet::new(graph);
    // 1. what carries what, and how it moves
    let tree = Tree::of(&mut sheet, bodies, &system.algebroid)?;
    let Fall { acceleration, rest } = Fall::of(sheet.graph, system, bodies)?;
    let mut motions = motions(&mut sheet, system, distribution, (&tree, acceleration))?;
    // 2. what is not of bodies
    let others = LagrangianSystem { lagrangian: rest, ..system.clone() };
    let mut others = reduced_equations(sheet.graph, &others, distribution);
    let turned = OtherAxes::of(&mut sheet, &tree, &mut motions, &others.mass);
    for axes in &turned {
        axes.turn_forces(&mut sheet, &mut others.force);
    }
    let mut joints = Joints {
        tree: &tree,
        motions: &motions,
        is_top: Vec::new(),
        mass: others.mass,
        force: others.force,
        eliminated: Vec::new(),
    };
    joints.is_top = joints.tops(&sheet, elimination);
    let tops = joints.velocities_of_tops();
    if elimination == Elimination::Everywhere && tops.len() + 1 >= independent {
        return None;
    }
    // 3. from the tips, and back
    joints.inwards(&mut sheet)?;
    let matrix: Matrix = tops.iter().map(|a| tops.iter().map(|b| joints.mass[*a][*b]).collect()).collect();
    let matrix: Matrix =
        matrix.iter().map(|row| row.iter().map(|entry| sheet.named("inertia", *entry)).collect()).collect();
    let right: Vec<ExprId> = tops.iter().map(|a| sheet.named("force", joints.force[*a])).collect();
    let found =
        solve_symmetric(sheet.graph, &matrix, &right, Definiteness::Definite, &mut sheet.procedure, "v_dot");
    let mut accelerations = vec![sheet.graph.zero(); independent];
    for (a, value) in tops.iter().zip(found) {
        accelerations[*a] = value;
    }
    joints.outwards(&mut sheet, &mut accelerations);
    for axes in &turned {
        axes.turn_accelerations(&mut sheet, &mut accelerations);
    }
    let Sheet { graph, procedure, .. } = sheet;
    let mut outputs = system.algebroid.rates(graph, &distribution.velocity);
    outputs.extend(accelerations);
    let whole = procedure.with_outputs(outputs);
    Some((whole.as_far_as(graph, &whole.outputs), turned))
}

/// A velocity that left at its joint: v̇ = rest − Σ shares · accelerations of what carries the joint.
struct Eliminated {
    frame: usize,
    velocity: usize,
    direction: Twist,
    shares: Twist,
    rest: ExprId,
}

struct Joints<'s> {
    tree: &'s Tree,
    motions: &'s [Motion],
    /// The frames whose velocities have a mass matrix.
    is_top: Vec<bool>,
    /// C of those, to which the bodies add.
    mass: Matrix,
    /// f.
    force: Vec<ExprId>,
    eliminated: Vec<Eliminated>,
}

impl Joints<'_> {
    /// The frames that velocities move which also move other frames, and what carries them.
    fn tops(&self, sheet: &Sheet, elimination: Elimination) -> Vec<bool> {
        let count = self.tree.frames.len();
        if elimination == Elimination::Nowhere {
            return vec![true; count];
        }
        let mut moved = vec![0; self.force.len()];
        for (a, _) in self.motions.iter().flat_map(|motion| &motion.columns) {
            moved[*a] += 1;
        }
        let is_local = |a: usize| {
            let others = |b: &usize| *b != a;
            let mut coupled = (0..self.force.len()).filter(others);
            moved[a] == 1 && coupled.all(|b| sheet.graph.is_literal_zero(self.mass[a][b]))
        };
        let mut is_top: Vec<bool> =
            self.motions.iter().map(|motion| motion.columns.iter().any(|(a, _)| !is_local(*a))).collect();
        for frame in (0..count).rev() {
            if let (true, Some(parent)) = (is_top[frame], self.tree.frames[frame].parent) {
                is_top[parent] = true;
            }
        }
        is_top
    }

    /// Their velocities, and those that move no frame.
    fn velocities_of_tops(&self) -> Vec<usize> {
        let below = |a: usize| {
            let mut frames = self.motions.iter().zip(&self.is_top);
            frames.any(|(motion, is_top)| !is_top && motion.columns.iter().any(|(b, _)| *b == a))
        };
        (0..self.force.len()).filter(|a| !below(*a)).collect()
    }

    /// Inertias and forces from each frame to the one that carries it.
    fn inwards(&mut self, sheet: &mut Sheet) -> Option<()> {
        let zero = sheet.zero();
        let mut inertias: Vec<Inertia> = self.tree.frames.iter().map(|frame| frame.inertia.clone()).collect();
        let mut forces: Vec<Twist> = vec![[zero; 2]; inertias.len()];
        for (index, frame) in self.tree.frames.iter().enumerate().rev() {
            let motion = &self.motions[index];
            let Inertia::Rigid { mass, moment, turning } = &frame.inertia else { return None };
            let moment = sheet.named_all("moment", *moment);
            let own = balance(sheet, motion, (*mass, &moment, turning));
            let [torque, force]: Twist = std::array::from_fn(|k| sheet.sum(own[k], forces[index][k]));
            let mut force = [sheet.named_all("torque", torque), sheet.named_all("force", force)];
            let mut inertia = inertias[index].named(sheet);
            for (a, direction) in &motion.columns {
                if self.is_top[index] {
                    let against = power(sheet, direction, &force);
                    self.force[*a] = sheet.graph.formula(self.force[*a] - against);
                } else {
                    (inertia, force) = self.eliminate(sheet, index, (*a, direction), (inertia, force));
                }
            }
            if self.is_top[index] {
                self.couple(sheet, index, &inertia);
            }
            if let Some(parent) = frame.parent {
                let carried = inertia.carried(sheet, &frame.turning, &frame.offset);
                inertias[parent] = inertias[parent].plus(sheet, &carried);
                let carried = force_carried(sheet, &frame.turning, &frame.offset, force);
                forces[parent] = std::array::from_fn(|k| sheet.sum(forces[parent][k], carried[k]));
            }
        }
        Some(())
    }

    /// The entries of C of the velocities of a frame, with their own and with those of what carries it.
    fn couple(&mut self, sheet: &mut Sheet, index: usize, inertia: &Inertia) {
        for (position, (a, direction)) in self.motions[index].columns.iter().enumerate() {
            let force = inertia.force(sheet, direction);
            let mut force = force.map(|part| sheet.named_all("momentum", part));
            for (b, other) in &self.motions[index].columns[position..] {
                let entry = power(sheet, other, &force);
                self.add(sheet, (*a, *b), entry);
            }
            let mut at = index;
            while let Some(parent) = self.tree.frames[at].parent {
                let frame = &self.tree.frames[at];
                force = force_carried(sheet, &frame.turning, &frame.offset, force);
                force = force.map(|part| sheet.named_all("momentum", part));
                for (b, other) in &self.motions[parent].columns {
                    let entry = power(sheet, other, &force);
                    self.add(sheet, (*a, *b), entry);
                    if a == b {
                        self.add(sheet, (*a, *b), entry);
                    }
                }
                at = parent;
            }
        }
    }

    fn add(&mut self, sheet: &mut Sheet, (a, b): (usize, usize), entry: ExprId) {
        self.mass[a][b] = sheet.graph.formula(self.mass[a][b] + entry);
        self.mass[b][a] = self.mass[a][b];
    }

    /// One velocity leaves: the inertia and the force that are left.
    fn eliminate(
        &mut self,
        sheet: &mut Sheet,
        frame: usize,
        (velocity, direction): (usize, &Twist),
        (inertia, force): (Inertia, Twist),
    ) -> (Inertia, Twist) {
        let along = inertia.force(sheet, direction).map(|part| sheet.named_all("along", part));
        let pivot = power(sheet, direction, &along);
        let pivot = sheet.graph.formula(pivot + self.mass[velocity][velocity]);
        let pivot = sheet.procedure.define(sheet.graph, "pivot", pivot);
        let against = power(sheet, direction, &force);
        let applied = self.force[velocity];
        let push = sheet.graph.formula(applied - against);
        let push = sheet.named("push", push);
        let inverse = sheet.graph.formula(1 / pivot);
        let inverse = sheet.named("inverse", inverse);
        let one = sheet.graph.one();
        let shares = along.map(|part| {
            part.map(|entry| {
                let share = if entry == pivot { one } else { sheet.graph.formula(entry * inverse) };
                sheet.named("share", share)
            })
        });
        let left = inertia.without(sheet, &along, &shares);
        let pushed: Twist = std::array::from_fn(|k| {
            std::array::from_fn(|i| {
                if shares[k][i] == one && against == force[k][i] {
                    applied
                } else {
                    sheet.graph.formula(force[k][i] + shares[k][i] * push)
                }
            })
        });
        let rest = sheet.graph.formula(push * inverse);
        let rest = sheet.named("rest", rest);
        self.eliminated.push(Eliminated { frame, velocity, direction: *direction, shares, rest });
        (left, pushed)
    }

    /// Accelerations from frame to frame, beyond those where v̇ = 0.
    fn outwards(&self, sheet: &mut Sheet, accelerations: &mut [ExprId]) {
        let is_needed = self.needed();
        let none = sheet.zero();
        let mut found: Vec<Twist> = vec![[none; 2]; self.tree.frames.len()];
        for (index, frame) in self.tree.frames.iter().enumerate() {
            if !is_needed[index] {
                continue;
            }
            let by = frame.parent.map_or([none; 2], |parent| found[parent]);
            let carried = acceleration_carried(sheet, &frame.turning, &frame.offset, by);
            let mut moved = carried.map(|part| sheet.named_all("acceleration", part));
            for eliminated in self.eliminated.iter().rev().filter(|eliminated| eliminated.frame == index) {
                let taken = power(sheet, &eliminated.shares, &moved);
                let value = sheet.graph.formula(eliminated.rest - taken);
                let value = sheet.named("v_dot", value);
                accelerations[eliminated.velocity] = value;
                moved = along(sheet, moved, &eliminated.direction, value);
            }
            if self.is_top[index] {
                for (a, direction) in &self.motions[index].columns {
                    moved = along(sheet, moved, direction, accelerations[*a]);
                }
            }
            found[index] = moved.map(|part| sheet.named_all("acceleration", part));
        }
    }

    /// The frames where velocities were eliminated, and what carries them.
    fn needed(&self) -> Vec<bool> {
        let mut is_needed = vec![false; self.tree.frames.len()];
        for eliminated in &self.eliminated {
            let mut at = Some(eliminated.frame);
            while let Some(frame) = at.filter(|frame| !is_needed[*frame]) {
                is_needed[frame] = true;
                at = self.tree.frames[frame].parent;
            }
        }
        is_needed
    }
}

fn along(sheet: &mut Sheet, moved: Twist, direction: &Twist, value: ExprId) -> Twist {
    std::array::from_fn(|k| {
        let step = sheet.scaled(value, direction[k]);
        sheet.sum(moved[k], step)
    })
}
