//! What the emitted items are called and how they are laid out: the names and tokens of a
//! declaration, where the verified system has only ids.
//!
//! Families stand in the order of their declaration. Their entries, row by row, one family after
//! the other, are in the order of the ids of the model: coordinates in that of `CoordId`, sections
//! in that of `SectionId`, parameters in that of `ParamId`, inputs in that of `InputId`, outputs in
//! that of `System::observables`.

use std::collections::{BTreeMap, BTreeSet};

use nonholonomic_core::id::SymbolId;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::syntax::ast;

/// The names and tokens of a declaration.
#[derive(Clone)]
pub(crate) struct Layout {
    /// The attribute's tokens, for the macro that hands the declaration on.
    pub(crate) attribute: TokenStream,
    /// The struct as it is emitted: verbatim, except for its `#[nh(…)]` attributes.
    pub(crate) item: TokenStream,
    /// The struct as it was written, for the macro that hands the declaration on.
    pub(crate) written: TokenStream,
    /// The attributes of the struct and of its fields.
    pub(crate) attributes: Vec<syn::Attribute>,
    /// The struct's name.
    pub(crate) name: Ident,
    /// Its visibility, which generated items take over.
    pub(crate) visibility: syn::Visibility,
    /// Its generics with bounds and `where` clause.
    pub(crate) generics: syn::Generics,
    /// The scalar type.
    pub(crate) scalar: ast::Scalar,
    /// Whether the scalar is a type that stands for the struct's parameter.
    pub(crate) is_fixed: bool,
    /// The fields that are no parameters.
    pub(crate) skipped: usize,
    /// The path of the runtime: `::nonholonomic`, unless the declaration says otherwise.
    pub(crate) runtime: TokenStream,
    /// The names of the generated types.
    pub(crate) types: TypeNames,
    /// The fields that are parameters, in order.
    pub(crate) parameters: Vec<Family>,
    /// Those of them, by their names without `r#`, that stand in no expression.
    pub(crate) idle: BTreeSet<String>,
    /// The base coordinates.
    pub(crate) coordinates: Vec<Family>,
    /// What the engine knows their entries by.
    pub(crate) coordinate_symbols: Vec<SymbolId>,
    /// The quasi-velocities; `x_dot` where E = TM.
    pub(crate) velocities: Vec<Family>,
    /// The sections of the frame.
    pub(crate) frame: Vec<Family>,
    /// What the engine knows the entries of `velocities`, then of `frame`, by.
    pub(crate) velocity_symbols: Vec<SymbolId>,
    /// The auxiliary states.
    pub(crate) auxiliary: Vec<Family>,
    /// What the engine knows their entries by.
    pub(crate) auxiliary_symbols: Vec<SymbolId>,
    /// The control inputs.
    pub(crate) inputs: Vec<Family>,
    /// The observables.
    pub(crate) outputs: Vec<Family>,
    /// The methods of the struct that are called, by their names without `r#`.
    pub(crate) methods: BTreeMap<String, Ident>,
}

/// The names of the generated types.
#[derive(Clone, Debug)]
pub(crate) struct TypeNames {
    /// `SleighState`
    pub(crate) state: Ident,
    /// `SleighVelocity`
    pub(crate) velocity: Ident,
    /// `SleighInput`
    pub(crate) input: Ident,
    /// `SleighMultipliers`
    pub(crate) multipliers: Ident,
    /// `SleighReactions`
    pub(crate) reactions: Ident,
    /// `SleighResidual`
    pub(crate) residual: Ident,
    /// `SleighOutputs`
    pub(crate) outputs: Ident,
    /// `SleighMomenta`
    pub(crate) momenta: Ident,
    /// `SleighPhase`
    pub(crate) phase: Ident,
    /// `SleighQuadratures`
    pub(crate) quadratures: Ident,
    /// `SleighGyroscopic`
    pub(crate) gyroscopic: Ident,
    /// `SleighPower`, with `SleighPowerOfForces` and `SleighPowerOfConstraints`
    pub(crate) power: Ident,
    /// `SleighCoordinate`
    pub(crate) coordinate: Ident,
    /// `SleighVariable`
    pub(crate) variable: Ident,
    /// `SleighImpulses`
    pub(crate) impulses: Ident,
}

impl TypeNames {
    /// The names that the types of a struct have if the declaration does not rename them.
    pub(crate) fn of(name: &Ident) -> Self {
        Self {
            state: format_ident!("{name}State"),
            velocity: format_ident!("{name}Velocity"),
            input: format_ident!("{name}Input"),
            multipliers: format_ident!("{name}Multipliers"),
            reactions: format_ident!("{name}Reactions"),
            residual: format_ident!("{name}Residual"),
            outputs: format_ident!("{name}Outputs"),
            momenta: format_ident!("{name}Momenta"),
            phase: format_ident!("{name}Phase"),
            quadratures: format_ident!("{name}Quadratures"),
            gyroscopic: format_ident!("{name}Gyroscopic"),
            power: format_ident!("{name}Power"),
            coordinate: format_ident!("{name}Coordinate"),
            variable: format_ident!("{name}Variable"),
            impulses: format_ident!("{name}Impulses"),
        }
    }
}

/// A declared name that becomes a field: a number, an array, or an array of arrays.
#[derive(Clone, Debug)]
pub(crate) struct Family {
    /// The identifier of the field, raw where it has to be, with its span.
    pub(crate) ident: Ident,
    /// The length of every index: none for a number, at most two.
    pub(crate) lengths: Vec<u32>,
    /// The user's doc comments, as attributes; may be empty.
    pub(crate) docs: TokenStream,
    /// The units of its entries; empty where they are not known.
    pub(crate) units: Vec<String>,
}

impl Family {
    /// The indices of the entries, row by row.
    pub(crate) fn entries(&self) -> Vec<Vec<u32>> {
        let mut entries = vec![Vec::new()];
        for length in &self.lengths {
            let extended = |entry: &Vec<u32>| {
                let entry = entry.clone();
                (0..*length).map(move |index| [entry.as_slice(), &[index]].concat())
            };
            entries = entries.iter().flat_map(extended).collect();
        }
        entries
    }

    /// The names of the entries in the declaration: `w[0]`.
    pub(crate) fn names(&self) -> Vec<String> {
        let name = plain(&self.ident);
        self.entries().iter().map(|entry| indexed(&name, entry)).collect()
    }
}

/// `w[0]`, for an entry of a family.
pub(super) fn indexed(name: &str, entry: &[u32]) -> String {
    entry.iter().fold(name.to_owned(), |text, index| format!("{text}[{index}]"))
}

/// An identifier without `r#`.
pub(super) fn plain(ident: &Ident) -> String {
    let text = ident.to_string();
    text.strip_prefix("r#").map(str::to_owned).unwrap_or(text)
}

impl From<&ast::Declared> for Family {
    fn from(declared: &ast::Declared) -> Self {
        Self {
            ident: declared.name.ident.clone(),
            lengths: declared.lengths.clone(),
            docs: declared.docs.clone(),
            units: Vec::new(),
        }
    }
}

impl Layout {
    /// The layout of a struct of which only the struct is known: what stubs can be made of.
    pub(crate) fn of_struct(structure: &ast::StructDecl, attribute: TokenStream) -> Self {
        Self {
            attribute,
            item: structure.item.clone(),
            written: structure.written.clone(),
            attributes: structure.attributes.clone(),
            name: structure.name.clone(),
            visibility: structure.visibility.clone(),
            generics: structure.generics.clone(),
            scalar: structure.scalar.clone(),
            is_fixed: false,
            skipped: structure.skipped.len(),
            runtime: quote!(::nonholonomic),
            types: TypeNames::of(&structure.name),
            parameters: structure.parameters.iter().map(Family::from).collect(),
            idle: BTreeSet::new(),
            coordinates: Vec::new(),
            coordinate_symbols: Vec::new(),
            velocities: Vec::new(),
            frame: Vec::new(),
            velocity_symbols: Vec::new(),
            auxiliary: Vec::new(),
            auxiliary_symbols: Vec::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            methods: BTreeMap::new(),
        }
    }

    /// A method of the struct, where the declaration calls it: what the compiler says of it is said there.
    pub(super) fn method(&self, name: &str) -> Ident {
        self.methods.get(name).cloned().unwrap_or_else(|| Ident::new(name, Span::call_site()))
    }

    /// The scalar type as tokens.
    pub(super) fn scalar_type(&self) -> TokenStream {
        match &self.scalar {
            ast::Scalar::F64 => quote!(::core::primitive::f64),
            ast::Scalar::F32 => quote!(::core::primitive::f32),
            ast::Scalar::Parameter(ident) => quote!(#ident),
        }
    }
}

/// A local name of generated code.
pub(super) fn local(name: &str) -> Ident {
    Ident::new(name, Span::mixed_site())
}
