//! The quotient of a declared system: the dropped coordinates and the invariant frame.

use std::collections::BTreeSet;

use nonholonomic_core::id::{CoordId, Id};
use nonholonomic_core::model::{Located, Model};
use nonholonomic_core::reduction::QuotientDecl;

use super::choices;
use super::context::Context;
use super::origins::Origins;
use super::related_systems::Unrelated;
use super::resolver::Resolver;
use crate::emit::{Family, Layout};
use crate::report::Diagnostic;
use crate::syntax::ast::SystemDecl;
use crate::syntax::quotient_syntax;

/// A quotient with its names resolved.
pub(crate) struct ResolvedQuotient {
    /// The full system.
    pub(crate) source: Model,
    /// What is asked for.
    pub(crate) declared: QuotientDecl,
    /// The families of the coordinates that are left.
    pub(crate) coordinates: Vec<Family>,
    /// The families of the quasi-velocities, where they are given.
    pub(crate) velocities: Option<Vec<Family>>,
    /// What the origins are.
    pub(crate) origins: Origins,
}

/// Resolves the declaration of the full system, and what its quotient says of it.
pub(crate) fn resolve_quotient(
    declaration: &quotient_syntax::QuotientDecl,
    source: &SystemDecl,
    layout: &mut Layout,
) -> Result<ResolvedQuotient, Unrelated> {
    let mut resolver = Resolver::new(choices::whole(source));
    resolver.homogeneity.wanted = source.sections.units.is_some();
    resolver.declare(source, layout);
    resolver.surroundings(source, layout);
    let mut source = resolver.model(source, layout);
    let ill_posed = resolver.reports.any();
    resolver.read_on(&mut source);
    resolver.share_also(&declaration.lets);
    let dropped = resolver.dropped(declaration);
    let velocities = declaration.velocities.as_ref().map(|section| {
        let (defined, _) = resolver.definitions(Context::MapVelocities, &section.body);
        let mut values = Vec::new();
        let mut families = Vec::new();
        for family in &defined {
            for (k, entry) in family.entries.iter().enumerate() {
                let name = family.shape().entry_name(&family.name.text, k);
                values.push((name, Located { value: entry.value, origin: resolver.origin(entry.extent) }));
            }
            families.push(family.family());
        }
        (values, families)
    });
    resolver.unused();
    resolver.units_of_map();
    source.graph = std::mem::take(&mut resolver.graph);
    let origin = resolver.origin(declaration.extent);
    let (coordinates, renamed) = left(layout, &dropped);
    let (values, velocities) = velocities.unzip();
    let declared = QuotientDecl { origin, dropped, velocities: values, renamed };
    let Resolver { origins, reports, .. } = resolver;
    match reports.finish(()) {
        _ if ill_posed => Err(Unrelated::IllPosed),
        Ok(()) => Ok(ResolvedQuotient { source, declared, coordinates, velocities, origins }),
        Err(errors) => Err(Unrelated::Errors(errors)),
    }
}

impl Resolver {
    /// The dropped coordinates, each once.
    fn dropped(&mut self, declaration: &quotient_syntax::QuotientDecl) -> Vec<CoordId> {
        let mut found = Vec::new();
        for place in &declaration.dropped {
            let Ok((named, part)) = self.coordinate(place) else { continue };
            for k in part.positions() {
                let id = CoordId::from_index(named.first + k);
                if found.contains(&id) {
                    let what = format!("`{}` is dropped twice", place.name.text);
                    self.report(place, Diagnostic::new(place.extent, what).way_out("name it once"));
                } else {
                    found.push(id);
                }
            }
        }
        found
    }
}

/// The families of what is left, and the names of entries that are left alone.
fn left(layout: &Layout, dropped: &[CoordId]) -> (Vec<Family>, Vec<(CoordId, String)>) {
    let dropped: BTreeSet<usize> = dropped.iter().map(|id| id.index()).collect();
    let (mut families, mut renamed) = (Vec::new(), Vec::new());
    let mut first = 0;
    for family in &layout.coordinates {
        let entries = family.entries();
        let places = first..first + entries.len();
        first = places.end;
        if places.clone().all(|place| !dropped.contains(&place)) {
            families.push(family.clone());
            continue;
        }
        for (place, entry) in places.zip(entries) {
            if dropped.contains(&place) {
                continue;
            }
            let name = entry.iter().fold(family.ident.to_string(), |name, index| format!("{name}_{index}"));
            let ident = quote::format_ident!("{name}", span = family.ident.span());
            renamed.push((CoordId::from_index(place), name));
            families.push(Family {
                ident,
                lengths: Vec::new(),
                docs: family.docs.clone(),
                units: Vec::new(),
            });
        }
    }
    (families, renamed)
}
