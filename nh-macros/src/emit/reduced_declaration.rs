//! A derived system as a declaration, and the map to it.

use std::collections::BTreeMap;

use nonholonomic_core::algebra::Constant;
use nonholonomic_core::id::{CoordId, ExprId};
use nonholonomic_core::model::Relation;
use nonholonomic_core::reduction::{Equation, Quotient};
use proc_macro2::{Literal, TokenStream, TokenTree};
use quote::quote;

use super::labels::{Group, grouped};
use super::layout::{Family, Layout};
use crate::syntax::ast::Scalar;
use crate::syntax::quotient_syntax::QuotientDecl;

/// What the quotient is written with.
pub(crate) struct Written<'a> {
    /// The derived system.
    pub(crate) quotient: &'a Quotient,
    /// What was asked for.
    pub(crate) declaration: &'a QuotientDecl,
    /// The layout of the full system.
    pub(crate) layout: &'a Layout,
    /// The coordinates that are left.
    pub(crate) coordinates: &'a [Family],
    /// The names of their entries that differ from those in the full system.
    pub(crate) renamed: &'a [(CoordId, String)],
    /// The quasi-velocities; those of the full system if not given.
    pub(crate) velocities: Option<&'a [Family]>,
    /// The path of the runtime.
    pub(crate) runtime: TokenStream,
}

/// `#[nonholonomic(…)] pub struct Reduced { … }` and `morphism! { Full -> Reduced { … } }`.
pub(crate) fn quotient(written: &Written<'_>) -> TokenStream {
    let Written { declaration, layout, runtime, .. } = written;
    let (attribute, map) = (written.attribute(), written.map());
    let (before, name, source) = (&declaration.before, &declaration.name, &declaration.source.path);
    // as a user writes it: the attribute reads it
    let scalar = match &layout.scalar {
        Scalar::F64 => quote!(f64),
        Scalar::F32 => quote!(f32),
        Scalar::Parameter(ident) => quote!(#ident),
    };
    let fields = layout.parameters.iter().map(|family| {
        let (ident, docs) = (&family.ident, &family.docs);
        let lengths = lengths(family);
        let type_of = lengths.iter().rev().fold(scalar.clone(), |inner, length| quote!([#inner; #length]));
        let doc = if docs.is_empty() { quote!(#[doc = " As in the full system."]) } else { docs.clone() };
        quote!(#doc pub #ident: #type_of)
    });
    let generics = match &layout.scalar {
        Scalar::Parameter(ident) => quote!(<#ident>),
        Scalar::F64 | Scalar::F32 => TokenStream::new(),
    };
    quote! {
        #[#runtime::__private::nonholonomic(#attribute)]
        #before struct #name #generics { #(#fields,)* }
        #runtime::__private::morphism! { #source -> #name { #map crate { #runtime } } }
    }
}

fn lengths(family: &Family) -> Vec<Literal> {
    family.lengths.iter().map(|length| Literal::u32_unsuffixed(*length)).collect()
}

/// `a, w[3]`
fn list(families: &[Family]) -> TokenStream {
    let entries = families.iter().map(|family| {
        let (ident, lengths) = (&family.ident, lengths(family));
        quote!(#ident #([#lengths])*)
    });
    quote!(#(#entries),*)
}

/// The same from the names of the entries.
fn list_of(names: &[String]) -> TokenStream {
    let mut families: Vec<(&str, Vec<usize>)> = Vec::new();
    for name in names {
        let mut parts = name.split(['[', ']']).filter(|part| !part.is_empty());
        let family = parts.next().unwrap_or_default();
        let lengths: Vec<usize> = parts.filter_map(|part| part.parse().ok()).map(|k: usize| k + 1).collect();
        match families.iter_mut().find(|(known, _)| *known == family) {
            None => families.push((family, lengths)),
            Some((_, known)) => known.iter_mut().zip(lengths).for_each(|(a, b)| *a = b.max(*a)),
        }
    }
    let entries = families.into_iter().map(|(family, lengths)| {
        let text = lengths.iter().fold(family.to_owned(), |text, length| format!("{text}[{length}]"));
        tokens(&text)
    });
    quote!(#(#entries),*)
}

/// The longest expression that is written down, in bytes: what is shared in the graph is not in a text.
const LONGEST: usize = 100_000;

/// Whether every expression of a quotient can be written down.
pub(crate) fn can_be_written(quotient: &Quotient) -> bool {
    let Quotient {
        source,
        velocities: _,
        map,
        anchor,
        brackets,
        identities,
        positions,
        is_redundant: _,
        lagrangian,
        constraints,
        forces,
        auxiliary,
    } = quotient;
    let sides = constraints.iter().chain(positions).flat_map(|equation| [equation.left, equation.right]);
    let facts = source.assumptions.iter().flat_map(|fact| [fact.left, fact.right]);
    let all = map.iter().chain(identities).copied().chain([*lagrangian]).chain(sides).chain(facts);
    let all = all.chain(anchor.iter().map(|(_, rate)| *rate)).chain(forces.iter().map(|(_, force)| *force));
    let all = all.chain(auxiliary.iter().map(|(_, rate)| *rate));
    let mut all = all.chain(brackets.iter().map(|(.., value)| *value));
    all.all(|expression| source.graph.text_within(expression, LONGEST).len() <= LONGEST)
}

/// `m = 13/10; J = [1/2, 0, 3];` What has no name of its own among the entries is not written by it.
fn definitions<'a>(constants: impl Iterator<Item = &'a Constant>) -> TokenStream {
    let mut families: Vec<(&str, BTreeMap<Vec<usize>, String>)> = Vec::new();
    for Constant { name, value } in constants {
        let mut parts = name.split(['[', ']']).filter(|part| !part.is_empty());
        let family = parts.next().unwrap_or_default();
        let indices = parts.filter_map(|part| part.parse().ok()).collect();
        if families.last().is_none_or(|(last, _)| *last != family) {
            families.push((family, BTreeMap::new()));
        }
        families.last_mut().and_then(|(_, entries)| entries.insert(indices, value.to_string()));
    }
    let definitions = families.into_iter().map(|(family, entries)| {
        let length = |k: usize| entries.keys().map(|indices| indices[k] + 1).max().unwrap_or(1);
        let entry = |indices: &[usize]| entries.get(indices).map_or("0", String::as_str).to_owned();
        let row = |before: &[usize], length: usize| {
            let entries = (0..length).map(|k| entry(&[before, &[k]].concat()));
            format!("[{}]", entries.collect::<Vec<_>>().join(", "))
        };
        let value = match entries.keys().next().map_or(0, Vec::len) {
            0 => entry(&[]),
            1 => row(&[], length(0)),
            _ => {
                let rows: Vec<String> = (0..length(0)).map(|k| row(&[k], length(1))).collect();
                format!("[{}]", rows.join(", "))
            }
        };
        tokens(&format!("{family} = {value};"))
    });
    quote!(#(#definitions)*)
}

/// Values in an array of these lengths, row by row.
fn in_rows(lengths: &[u32], values: impl Iterator<Item = TokenStream>) -> TokenStream {
    let values: Vec<TokenStream> = values.collect();
    match *lengths {
        [] => values.into_iter().collect(),
        [_] => quote!([#(#values),*]),
        [_, columns, ..] => {
            let rows = values.chunks(columns.max(1) as usize).map(|row| quote!([#(#row),*]));
            quote!([#(#rows),*])
        }
    }
}

/// What was printed, as tokens.
fn tokens(text: &str) -> TokenStream {
    text.parse().unwrap_or_default()
}

impl Written<'_> {
    fn text(&self, expression: ExprId) -> TokenStream {
        tokens(&self.quotient.source.graph.text(expression))
    }

    /// The name of a coordinate in the quotient.
    fn coordinate(&self, id: CoordId) -> TokenStream {
        let renamed = self.renamed.iter().find(|(known, _)| *known == id).map(|(_, name)| name);
        tokens(renamed.unwrap_or(&self.quotient.source.coordinates[id].name))
    }

    /// Whether a section is passed on.
    fn passes(&self, section: &str) -> bool {
        let is_it = |token: TokenTree| matches!(token, TokenTree::Ident(ident) if ident == section);
        self.declaration.passed.clone().into_iter().any(is_it)
    }

    /// The sections of the derived declaration.
    fn attribute(&self) -> TokenStream {
        let Self { quotient, declaration, layout, runtime, .. } = self;
        let names: Vec<TokenStream> = quotient.velocities.iter().map(|name| tokens(name)).collect();
        let mut sections = TokenStream::new();
        let constants = quotient.source.graph.constants();
        if !constants.is_empty() && !self.passes("constants") {
            let definitions = definitions(constants.iter());
            sections.extend(quote!(constants { #definitions }));
        }
        if !quotient.anchor.is_empty() {
            let coordinates = list(self.coordinates);
            let lines = quotient.anchor.iter().map(|(id, rate)| {
                let (name, rate) = (self.coordinate(*id), self.text(*rate));
                quote!(der(#name) = #rate;)
            });
            sections.extend(quote!(base { #coordinates } anchor { #(#lines)* }));
        }
        if !quotient.identities.is_empty() && !self.passes("on") {
            let identities = quotient.identities.iter().map(|identity| self.text(*identity));
            sections.extend(quote!(on { #(#identities = 0;)* }));
        }
        let basis = self.velocities.map_or_else(|| list_of(&quotient.velocities), list);
        let brackets = quotient.brackets.iter().map(|(a, b, value)| {
            let (a, b, value) = (&names[*a], &names[*b], self.text(*value));
            quote!([#a, #b] = #value;)
        });
        let lagrangian = self.text(quotient.lagrangian);
        sections.extend(quote! {
            basis { #basis }
            brackets { #(#brackets)* }
            lagrangian { #lagrangian }
        });
        if quotient.source.almost {
            sections.extend(quote!(almost;));
        }
        if !quotient.positions.is_empty() {
            let equations = self.equations(&quotient.positions);
            let redundant = quotient.is_redundant.then(|| quote!(redundant;));
            sections.extend(quote!(holonomic { #equations #redundant }));
        }
        if !quotient.constraints.is_empty() {
            let equations = self.equations(&quotient.constraints);
            sections.extend(quote!(constraints { #equations }));
        }
        if !quotient.forces.is_empty() {
            let forces = quotient.forces.iter().map(|(k, force)| {
                let (name, force) = (&names[*k], self.text(*force));
                quote!(#name: #force;)
            });
            sections.extend(quote!(forces { #(#forces)* }));
        }
        if !quotient.auxiliary.is_empty() {
            let rates = quotient.auxiliary.iter().map(|(name, rate)| {
                let (name, rate) = (tokens(name), self.text(*rate));
                quote!(der(#name) = #rate;)
            });
            sections.extend(quote!(auxiliary { #(#rates)* }));
        }
        if !layout.inputs.is_empty() {
            let inputs = list(&layout.inputs);
            sections.extend(quote!(inputs { #inputs }));
        }
        if !quotient.source.assumptions.is_empty() && !self.passes("assume") {
            let facts = quotient.source.assumptions.iter().map(|fact| {
                let (left, right) = (self.text(fact.left), self.text(fact.right));
                let relation = match fact.relation {
                    Relation::Less => quote!(<),
                    Relation::LessOrEqual => quote!(<=),
                    Relation::Greater => quote!(>),
                    Relation::GreaterOrEqual => quote!(>=),
                    Relation::NotEqual => quote!(!=),
                };
                quote!(#left #relation #right;)
            });
            sections.extend(quote!(assume { #(#facts)* }));
        }
        let passed = &declaration.passed;
        quote!(#sections #passed crate { #runtime })
    }

    /// Equations with their labels, those of an array together.
    fn equations(&self, equations: &[Equation]) -> TokenStream {
        let labels: Vec<_> = equations.iter().map(|equation| equation.label.as_deref()).collect();
        let lines = grouped(&labels).into_iter().map(|Group { name, lengths, places }| {
            let label = name.map(|name| {
                let name = tokens(&name);
                quote!(#name:)
            });
            let equations = &equations[places];
            let left = in_rows(&lengths, equations.iter().map(|equation| self.text(equation.left)));
            let right = in_rows(&lengths, equations.iter().map(|equation| self.text(equation.right)));
            quote!(#label #left = #right;)
        });
        lines.collect()
    }

    /// The sections of the map.
    fn map(&self) -> TokenStream {
        let base = self.renamed.iter().map(|(id, name)| {
            let (name, old) = (tokens(name), tokens(&self.quotient.source.coordinates[*id].name));
            quote!(#name = #old;)
        });
        let velocities = self.quotient.velocities.iter().zip(&self.quotient.map).map(|(name, value)| {
            let (name, value) = (tokens(name), self.text(*value));
            quote!(#name = #value;)
        });
        quote!(base { #(#base)* } velocities { #(#velocities)* })
    }
}
