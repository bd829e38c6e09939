//! Generated plain structs: the state, the velocities, inputs and outputs.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, quote};

use super::infix::element;
use super::layout::{Family, indexed, local, plain};
use super::lint::allow_for;
use super::setting::Context;

/// A struct of numbers and arrays of numbers.
pub(super) struct Record {
    pub(super) name: Ident,
    pub(super) doc: String,
    pub(super) fields: Vec<Field>,
}

/// One field of it.
pub(super) struct Field {
    pub(super) ident: Ident,
    lengths: Vec<u32>,
    /// Doc attributes.
    docs: TokenStream,
    /// The names of its components in the declaration.
    names: Vec<String>,
}

/// Arrays beyond this length have no `Default` and no serde of their own.
const LONG: u32 = 32;

impl Field {
    /// The field of a whole family.
    pub(super) fn of(family: &Family, what: &str) -> Self {
        let name = plain(&family.ident);
        let names = family.names();
        let docs = if family.docs.is_empty() {
            let plural = if family.lengths.is_empty() { "" } else { "s" };
            let what = if plural == "s" && what == "quasi-velocity" {
                "quasi-velocities".to_owned()
            } else {
                format!("{what}{plural}")
            };
            let doc = format!(" The {what} `{name}`.");
            quote!(#[doc = #doc])
        } else {
            family.docs.clone()
        };
        let docs = with_units(docs, &family.units);
        Self { ident: family.ident.clone(), lengths: family.lengths.clone(), docs, names }
    }

    /// The field of one entry of a family.
    pub(super) fn of_entry(family: &Family, entry: &[u32], what: &str) -> Self {
        let name = plain(&family.ident);
        let field = entry.iter().fold(name.clone(), |text, index| format!("{text}_{index}"));
        let component = indexed(&name, entry);
        let doc = format!(" The {what} `{component}`.");
        let mut docs = family.docs.clone();
        if !docs.is_empty() {
            docs.extend(quote!(#[doc = ""]));
        }
        docs.extend(quote!(#[doc = #doc]));
        let position = family.entries().iter().position(|known| known == entry);
        let unit = position.and_then(|position| family.units.get(position));
        let docs = with_units(docs, unit.map_or(&[], std::slice::from_ref));
        Self {
            ident: Ident::new(&field, family.ident.span()),
            lengths: Vec::new(),
            docs,
            names: vec![component],
        }
    }

    /// The same field under other documentation.
    pub(super) fn described(&self, doc: &str) -> Self {
        let Self { ident, lengths, names, .. } = self;
        Self {
            ident: ident.clone(),
            lengths: lengths.clone(),
            docs: quote!(#[doc = #doc]),
            names: names.clone(),
        }
    }

    /// The same field under another name.
    pub(super) fn renamed(&self, ident: Ident, doc: &str) -> Self {
        let name = plain(&ident);
        let own = plain(&self.ident);
        let named = |component: &String| component.replacen(&own, &name, 1);
        let names = self.names.iter().map(named).collect();
        Self { ident, lengths: self.lengths.clone(), docs: quote!(#[doc = #doc]), names }
    }

    /// The number of its components.
    pub(super) fn len(&self) -> usize {
        self.names.len()
    }

    /// The names of its components in the declaration.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether it is an array.
    pub(super) fn is_family(&self) -> bool {
        !self.lengths.is_empty()
    }

    fn type_of(&self, scalar: &TokenStream) -> TokenStream {
        self.lengths.iter().rev().fold(scalar.clone(), |inner, length| {
            let length = Literal::u32_unsuffixed(*length);
            quote!([#inner; #length])
        })
    }

    /// Its value from the values of its components in order.
    fn value(&self, components: &[TokenStream]) -> TokenStream {
        match *self.lengths {
            [] => components.iter().cloned().collect(),
            [_] => {
                let elements = components.iter().map(element);
                quote!([#(#elements),*])
            }
            [_, columns, ..] => {
                let rows = components.chunks(columns.max(1) as usize).map(|row| {
                    let elements = row.iter().map(element);
                    quote!([#(#elements),*])
                });
                quote!([#(#rows),*])
            }
        }
    }

    /// `.theta[0]` for each component.
    fn places(&self) -> Vec<TokenStream> {
        let ident = &self.ident;
        let family = Family {
            ident: ident.clone(),
            lengths: self.lengths.clone(),
            docs: TokenStream::new(),
            units: Vec::new(),
        };
        let place = |entry: &Vec<u32>| {
            let indices = entry.iter().map(|index| Literal::u32_unsuffixed(*index));
            quote!(.#ident #([#indices])*)
        };
        family.entries().iter().map(place).collect()
    }
}

/// Documentation with the units of the components behind it.
fn with_units(mut docs: TokenStream, units: &[String]) -> TokenStream {
    let Some(first) = units.first() else { return docs };
    let doc = if units.iter().all(|unit| unit == first) {
        format!(" Unit: {first}.")
    } else {
        format!(" Units: {}.", units.join(", "))
    };
    docs.extend(quote!(#[doc = ""] #[doc = #doc]));
    docs
}

impl Record {
    /// The fields with the lengths of their indices.
    pub(super) fn declared(&self) -> Vec<(String, &[u32])> {
        self.fields.iter().map(|field| (plain(&field.ident), field.lengths.as_slice())).collect()
    }

    /// The number of components.
    pub(super) fn len(&self) -> usize {
        self.fields.iter().map(|field| field.names.len()).sum()
    }

    /// The components' names in the declaration, in order.
    pub(super) fn names(&self) -> impl Iterator<Item = &String> {
        self.fields.iter().flat_map(|field| &field.names)
    }

    /// `base.theta[0]` for each component, in order.
    pub(super) fn places(&self, base: &impl ToTokens) -> Vec<TokenStream> {
        let places = self.fields.iter().flat_map(Field::places);
        places.map(|place| quote!(#base #place)).collect()
    }

    /// `Name { theta: …, … }` from the values of its components in order.
    pub(super) fn construct(&self, name: &TokenStream, components: &[TokenStream]) -> TokenStream {
        let mut rest = components;
        let mut fields = Vec::new();
        for field in &self.fields {
            let (own, others) = rest.split_at(field.names.len().min(rest.len()));
            rest = others;
            let (ident, value) = (&field.ident, field.value(own));
            fields.push(quote!(#ident: #value));
        }
        quote!(#name { #(#fields),* })
    }

    /// The struct and the conversions that it has apart from any system.
    pub(super) fn emit(&self, context: &Context) -> TokenStream {
        let Context { visibility, scalar, lints, .. } = context;
        let (name, doc) = (&self.name, format!(" {}", self.doc));
        let generics = context.record_generics();
        let is_long = self.fields.iter().any(|field| field.lengths.iter().any(|length| *length > LONG));
        let default = (!is_long).then(|| quote!(, ::core::default::Default));
        // derived with a parameter, linters would ask for `Eq`, which floating-point numbers have not
        let equality = context.parameter().is_none().then(|| quote!(, ::core::cmp::PartialEq));
        let allow = allow_for(self.fields.iter().map(|field| &field.ident));
        let fields = self.fields.iter().map(|field| {
            let Field { ident, docs, .. } = field;
            let type_of = field.type_of(scalar);
            quote!(#docs pub #ident: #type_of)
        });
        let equality_of_parameter = context.parameter().map(|_| self.equality(context));
        let conversions = self.conversions(context);
        let extra = if is_long { self.long_default(context) } else { self.serde(context) };
        quote! {
            #[doc = #doc]
            #[derive(
                ::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug #equality #default
            )]
            #allow
            #lints
            #visibility struct #name #generics { #(#fields,)* }
            #equality_of_parameter
            #conversions
            #extra
        }
    }

    /// `PartialEq`, field by field.
    fn equality(&self, context: &Context) -> TokenStream {
        let (generics, record, lints) =
            (context.record_impl_generics(), context.type_of(self), &context.lints);
        let other = local("other");
        let fields = self.fields.iter().map(|field| &field.ident);
        quote! {
            #lints
            impl #generics ::core::cmp::PartialEq for #record {
                fn eq(&self, #other: &Self) -> ::core::primitive::bool {
                    true #(&& self.#fields == #other.#fields)*
                }
            }
        }
    }

    /// To and from arrays and nalgebra's vectors.
    fn conversions(&self, context: &Context) -> TokenStream {
        let Context { runtime, scalar, lints, .. } = context;
        let generics = context.record_impl_generics();
        let record = context.type_of(self);
        let length = Literal::usize_unsuffixed(self.len());
        let value = local("value");
        let places = self.places(&value);
        let components: Vec<_> = (0..self.len()).map(|index| local(&format!("c{index}"))).collect();
        let tokens: Vec<_> = components.iter().map(ToTokens::to_token_stream).collect();
        let built = self.construct(&quote!(Self), &tokens);
        quote! {
            #lints
            #[automatically_derived]
            impl #generics ::core::convert::From<#record> for [#scalar; #length] {
                #[inline]
                fn from(#value: #record) -> Self { [#(#places),*] }
            }
            #lints
            #[automatically_derived]
            impl #generics ::core::convert::From<[#scalar; #length]> for #record {
                #[inline]
                fn from([#(#components),*]: [#scalar; #length]) -> Self { #built }
            }
            #lints
            #[automatically_derived]
            impl #generics ::core::convert::From<#record> for #runtime::nalgebra::SVector<#scalar, #length> {
                #[inline]
                fn from(#value: #record) -> Self {
                    ::core::convert::From::<[#scalar; #length]>::from(::core::convert::From::from(#value))
                }
            }
            #lints
            #[automatically_derived]
            impl #generics ::core::convert::From<#runtime::nalgebra::SVector<#scalar, #length>> for #record {
                #[inline]
                fn from(#value: #runtime::nalgebra::SVector<#scalar, #length>) -> Self {
                    ::core::convert::From::<[#scalar; #length]>::from(::core::convert::From::from(#value))
                }
            }
        }
    }

    /// `Default` for arrays that have none.
    fn long_default(&self, context: &Context) -> TokenStream {
        let Context { runtime, scalar, lints, .. } = context;
        let (generics, record) = (context.record_impl_generics(), context.type_of(self));
        let zero = quote!(<#scalar as #runtime::Scalar>::ZERO);
        let fields = self.fields.iter().map(|field| {
            let ident = &field.ident;
            let value = field.lengths.iter().rev().fold(zero.clone(), |inner, length| {
                let length = Literal::u32_unsuffixed(*length);
                quote!([#inner; #length])
            });
            quote!(#ident: #value)
        });
        quote! {
            #lints
            #[automatically_derived]
            impl #generics ::core::default::Default for #record {
                fn default() -> Self { Self { #(#fields),* } }
            }
        }
    }

    /// Hands the struct to the runtime, which knows whether its `serde` feature is on.
    fn serde(&self, context: &Context) -> TokenStream {
        let Context { runtime, scalar, lints, .. } = context;
        let path = format!("{runtime}::serde").replace(' ', "");
        let (name, text) = (&self.name, plain(&self.name));
        let parameter = context.parameter().map(|parameter| quote!(<#parameter>));
        let allow = allow_for(self.fields.iter().map(|field| &field.ident));
        let fields = self.fields.iter().map(|field| {
            let (ident, type_of) = (&field.ident, field.type_of(scalar));
            quote!(#ident: #type_of)
        });
        quote! {
            #runtime::serde_impls! {
                #path, #text, { #allow #lints } #name [#parameter] { #(#fields,)* }
            }
        }
    }
}
