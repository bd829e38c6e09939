//! The struct under the attribute: its fields are the parameters, of one scalar type.

use std::fmt;

use proc_macro2::{Delimiter, Group, Ident, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::spanned::Spanned;
use syn::{Data, DeriveInput, Fields, Type};

use super::ast::{Declared, Name, Scalar, StructDecl};
use super::names::{check_lengths, is_mark};
use super::render::render;
use crate::report::{Diagnostic, Errors, Extent};

/// The item without `#[nh(…)]`, which no compiler would know.
pub(crate) fn without_own_attributes(item: TokenStream) -> TokenStream {
    let mut kept: Vec<TokenTree> = Vec::new();
    for token in item {
        let own = match &token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket => {
                let word = group.stream().into_iter().next();
                matches!(word, Some(TokenTree::Ident(ident)) if ident == "nh")
            }
            _ => false,
        };
        if own && kept.last().is_some_and(|last| is_mark(last, '#')) {
            kept.pop();
            continue;
        }
        kept.push(match token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                let mut fields = Group::new(Delimiter::Brace, fields_without_own(group.stream()));
                fields.set_span(group.span());
                TokenTree::Group(fields)
            }
            token => token,
        });
    }
    kept.into_iter().collect()
}

/// The same for fields, where nothing deeper is looked into.
fn fields_without_own(fields: TokenStream) -> TokenStream {
    let mut kept: Vec<TokenTree> = Vec::new();
    for token in fields {
        let own = matches!(&token, TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket
            && matches!(group.stream().into_iter().next(), Some(TokenTree::Ident(word)) if word == "nh"));
        if own && kept.last().is_some_and(|last| is_mark(last, '#')) {
            kept.pop();
        } else {
            kept.push(token);
        }
    }
    kept.into_iter().collect()
}

/// Reads the item.
pub(crate) fn structure(item: TokenStream, errors: &mut Errors) -> Option<StructDecl> {
    let (written, stripped) = (item.clone(), without_own_attributes(item.clone()));
    if let Some(error) = no_struct(&item) {
        errors.push(error);
        return None;
    }
    let input = errors.keep(syn::parse2::<DeriveInput>(item).map_err(Diagnostic::from))?;
    let fields: Vec<&syn::Field> = match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Named(fields) => fields.named.iter().collect(),
            Fields::Unit => Vec::new(),
            Fields::Unnamed(fields) => {
                errors.push(
                    Diagnostic::new(of(fields), "the fields of this struct have no names")
                        .way_out("parameters are named: `struct Sleigh { m: f64, a: f64 }`"),
                );
                // what is said of it is enough
                Vec::new()
            }
        },
        Data::Enum(_) | Data::Union(_) => return None,
    };
    for attribute in input.attrs.iter().filter(|attribute| attribute.path().is_ident("nh")) {
        errors.push(
            Diagnostic::new(of(attribute), "`nh` attributes belong to fields")
                .way_out("`#[nh(skip)]` before a field leaves that field alone"),
        );
    }
    for parameter in input.generics.const_params() {
        errors.push(
            Diagnostic::new(of(parameter), "const parameters are not supported")
                .way_out("the equations are derived for fixed sizes: write the number"),
        );
    }
    let constants: Vec<&Ident> = input.generics.const_params().map(|parameter| &parameter.ident).collect();
    let mut reader = FieldReader { generics: &input.generics, scalar: None };
    let mut parameters = Vec::new();
    let mut skipped = Vec::new();
    for field in &fields {
        match reader.field(field) {
            Ok(Some(parameter)) => parameters.push(parameter),
            Ok(None) => skipped.extend(field.ident.clone().map(Name::new)),
            // of the parameter that gives the length it was said
            Err(_) if constants.iter().any(|constant| names(&field.ty, constant)) => {}
            Err(error) => errors.push(error),
        }
    }
    let of_fields = fields.iter().flat_map(|field| &field.attrs);
    let attributes = input.attrs.iter().chain(of_fields).cloned().collect();
    let scalar = reader.scalar.map_or(Scalar::F64, |(scalar, _)| scalar);
    Some(StructDecl {
        item: stripped,
        written,
        attributes,
        name: input.ident,
        visibility: input.vis,
        generics: input.generics,
        scalar,
        parameters,
        skipped,
    })
}

/// Items that are no structs.
fn no_struct(item: &TokenStream) -> Option<Diagnostic> {
    let first = item.clone().into_iter().find_map(|token| match token {
        TokenTree::Ident(ident) => {
            let word = ident.to_string();
            ["struct", "enum", "union", "fn", "impl", "trait", "mod", "type", "const", "static", "use"]
                .contains(&word.as_str())
                .then_some((word, ident.span()))
        }
        _ => None,
    });
    let (word, span) = match first {
        Some((word, _)) if word == "struct" => return None,
        Some(found) => found,
        None => ("this item".to_owned(), item.span()),
    };
    let what = match word.as_str() {
        "this item" => "this is no struct".to_owned(),
        word => format!("`{word}` is no struct"),
    };
    Some(Diagnostic::new(Extent::at(span), what).way_out(
        "`#[nonholonomic]` stands before the struct of the parameters: `struct Sleigh { m: f64, a: f64 }`",
    ))
}

/// Whether a name stands in a syntax tree.
fn names(tokens: &impl ToTokens, name: &Ident) -> bool {
    fn within(tokens: TokenStream, name: &Ident) -> bool {
        tokens.into_iter().any(|token| match token {
            TokenTree::Ident(ident) => ident == *name,
            TokenTree::Group(group) => within(group.stream(), name),
            _ => false,
        })
    }
    within(tokens.to_token_stream(), name)
}

/// The extent of a syntax tree.
fn of(tokens: &impl ToTokens) -> Extent {
    let tokens: Vec<TokenTree> = tokens.to_token_stream().into_iter().collect();
    Extent::of(&tokens).unwrap_or(Extent::at(Span::call_site()))
}

/// Reads fields and watches that they agree on the scalar type.
struct FieldReader<'a> {
    generics: &'a syn::Generics,
    /// The scalar type and the field that decided it.
    scalar: Option<(Scalar, Ident)>,
}

impl FieldReader<'_> {
    /// A parameter, or nothing for a field to be left alone.
    fn field(&mut self, field: &syn::Field) -> Result<Option<Declared>, Diagnostic> {
        let Some(ident) = field.ident.clone() else { return Ok(None) };
        let marks = marks(field)?;
        if marks.skipped {
            return Ok(None);
        }
        if let Some(attribute) = field.attrs.iter().find(|attribute| attribute.path().is_ident("cfg")) {
            return Err(Diagnostic::new(of(attribute), "a parameter cannot depend on `cfg`")
                .evidence("the declaration is read before the compiler decides which fields there are")
                .way_out("put the `#[cfg]` on the whole struct, and write one struct for each case"));
        }
        let (lengths, leaf) = shape(&field.ty)?;
        self.scalar(leaf, &field.ty, &ident)?;
        let docs = field.attrs.iter().filter(|attribute| attribute.path().is_ident("doc"));
        let docs = quote!(#(#docs)*);
        let extent = Extent::at(ident.span());
        check_lengths(&lengths, of(&field.ty))?;
        if let (Some(attribute), false) =
            (marks.symmetric, matches!(lengths.as_slice(), [rows, columns] if rows == columns))
        {
            let written = render(&field.ty.to_token_stream().into_iter().collect::<Vec<_>>());
            return Err(Diagnostic::new(
                of(attribute),
                format!("`{ident}` is marked symmetric, and is no square matrix"),
            )
            .evidence(format!("it is `{written}`"))
            .way_out("a symmetric matrix reads `#[nh(symmetric)] I: [[f64; 3]; 3]`"));
        }
        let symmetric = marks.symmetric.is_some();
        Ok(Some(Declared { docs, name: Name::new(ident), lengths, symmetric, extent }))
    }

    /// Reads the scalar type of a field; all fields have the same.
    fn scalar(&mut self, leaf: &Type, whole: &Type, field: &Ident) -> Result<(), Diagnostic> {
        let found = match leaf {
            Type::Path(path) if path.qself.is_none() => match primitive(&path.path) {
                Some(ident) if ident == "f64" => Some(Scalar::F64),
                Some(ident) if ident == "f32" => Some(Scalar::F32),
                Some(ident) if self.generics.type_params().any(|parameter| parameter.ident == *ident) => {
                    Some(Scalar::Parameter(ident.clone()))
                }
                _ => None,
            },
            _ => None,
        };
        let written = render(&leaf.to_token_stream().into_iter().collect::<Vec<_>>());
        let Some(found) = found else {
            return Err(Diagnostic::new(of(whole), format!("`{written}` is not the type of a parameter"))
                .way_out(
                    "parameters are `f64`, `f32` or a type parameter, or arrays of it; a field marked \
                     `#[nh(skip)]` is left alone",
                ));
        };
        match &self.scalar {
            None => self.scalar = Some((found, field.clone())),
            Some((scalar, first)) if scalar.word() != found.word() => {
                return Err(Diagnostic::new(of(whole), "the parameters are of two scalar types")
                    .evidence(format!(
                        "`{first}` is made of `{}`, `{field}` of `{}`",
                        scalar.word(),
                        found.word()
                    ))
                    .way_out("give them the same type"));
            }
            Some(_) => {}
        }
        Ok(())
    }
}

impl fmt::Debug for StructDecl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("StructDecl").field("item", &self.item.to_string()).finish_non_exhaustive()
    }
}

impl Scalar {
    /// As it is written.
    pub(crate) fn word(&self) -> String {
        match self {
            Self::F64 => "f64".to_owned(),
            Self::F32 => "f32".to_owned(),
            Self::Parameter(name) => name.to_string(),
        }
    }
}

/// The name of a type: a word alone, or the path of a primitive type, `::core::primitive::f64`.
fn primitive(path: &syn::Path) -> Option<&Ident> {
    if let Some(ident) = path.get_ident() {
        return Some(ident);
    }
    let plain = path.segments.iter().all(|segment| segment.arguments.is_none());
    let words: Vec<&Ident> = path.segments.iter().map(|segment| &segment.ident).collect();
    match words.as_slice() {
        [root, module, name] if plain && *module == "primitive" && (*root == "core" || *root == "std") => {
            (*name == "f64" || *name == "f32").then_some(*name)
        }
        _ => None,
    }
}

/// What `#[nh(…)]` before a field says.
#[derive(Default)]
struct Marks<'a> {
    /// The field is left alone.
    skipped: bool,
    /// Entries (i, j) and (j, i) are one parameter: where that is said.
    symmetric: Option<&'a syn::Attribute>,
}

/// Reads the marks of a field.
fn marks(field: &syn::Field) -> Result<Marks<'_>, Diagnostic> {
    let mut marks = Marks::default();
    for attribute in field.attrs.iter().filter(|attribute| attribute.path().is_ident("nh")) {
        match attribute.parse_args::<Ident>() {
            Ok(word) if word == "skip" => marks.skipped = true,
            Ok(word) if word == "symmetric" => marks.symmetric = Some(attribute),
            _ => {
                return Err(Diagnostic::new(of(attribute), "unknown attribute of a field").way_out(
                    "write `#[nh(skip)]`, which leaves the field alone, or `#[nh(symmetric)]` before a square matrix",
                ));
            }
        }
    }
    Ok(marks)
}

/// The lengths of an array type and what it is an array of.
fn shape(ty: &Type) -> Result<(Vec<u32>, &Type), Diagnostic> {
    let mut lengths = Vec::new();
    let mut leaf = ty;
    loop {
        match leaf {
            Type::Group(inner) => leaf = &inner.elem,
            Type::Paren(inner) => leaf = &inner.elem,
            Type::Array(array) => {
                if lengths.len() == 2 {
                    return Err(Diagnostic::new(of(ty), "an array of more than two indices")
                        .way_out("use several fields"));
                }
                lengths.push(length(&array.len)?);
                leaf = &array.elem;
            }
            leaf => return Ok((lengths, leaf)),
        }
    }
}

/// The length of an array type.
fn length(expr: &syn::Expr) -> Result<u32, Diagnostic> {
    let mut inner = expr;
    while let syn::Expr::Group(group) = inner {
        inner = &group.expr;
    }
    if let syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(literal), .. }) = inner
        && let Ok(length) = literal.base10_parse::<u32>()
    {
        return Ok(length);
    }
    Err(Diagnostic::new(of(expr), "the length of a parameter array must be written as a number")
        .evidence("constants are evaluated only after the equations are derived")
        .way_out("write `[f64; 3]`"))
}
