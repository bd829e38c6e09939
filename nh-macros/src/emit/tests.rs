//! Emitted code against golden files: `UPDATE_GOLDEN=1 cargo test -p nonholonomic-macros` writes them anew.

use nonholonomic_core::model::Request;
use proc_macro2::{TokenStream, TokenTree};
use std::path::Path;

use super::samples::{chain, chain_system, layout, rails, rails_system, sleigh, sleigh_system};
use super::{emit, stubs};
use crate::resolve::Outline;

/// Compares with a golden file, or writes it.
fn golden(name: &str, tokens: TokenStream) {
    let file = syn::parse2(tokens).expect("emitted code is a list of items");
    let text = prettyplease::unparse(&file);
    let path = format!("{}/tests/golden/{name}.rs", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(&path, text).expect("the golden file can be written");
        return;
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    let differs = text.lines().zip(expected.lines()).position(|(new, old)| new != old);
    let line = differs.unwrap_or_else(|| text.lines().count().min(expected.lines().count()));
    let of = |text: &str| text.lines().nth(line).unwrap_or("(end)").to_owned();
    assert!(
        text == expected,
        "{path}:{}\n  golden: {}\n  now:    {}\nrun with UPDATE_GOLDEN=1 if this is meant",
        line + 1,
        of(&expected),
        of(&text),
    );
}

/// A whole expansion in two golden files: the records with what they convert from and into, and what is computed.
fn golden_with_records(name: &str, tokens: TokenStream) {
    let file = syn::parse2::<syn::File>(tokens).expect("emitted code is a list of items");
    let (records, rest): (Vec<syn::Item>, Vec<syn::Item>) = file.items.into_iter().partition(is_of_record);
    golden(&format!("{name}_records"), quote::quote!(#(#records)*));
    golden(name, quote::quote!(#(#rest)*));
}

/// Whether an item is a struct, or says what one converts from and into.
fn is_of_record(item: &syn::Item) -> bool {
    match item {
        syn::Item::Struct(_) => true,
        syn::Item::Macro(call) => call.mac.path.segments.iter().any(|part| part.ident == "serde_impls"),
        syn::Item::Impl(item) => {
            let of = item.trait_.as_ref().and_then(|(path, _)| path.segments.last());
            of.is_some_and(|last| ["From", "State"].contains(&last.ident.to_string().as_str()))
        }
        _ => false,
    }
}

#[test]
fn a_sleigh() {
    let layout = layout(&sleigh());
    golden_with_records("by_hand_sleigh", emit(&sleigh_system(&layout), &layout).expect("proved programs"));
}

#[test]
fn families_and_a_type_parameter() {
    let layout = layout(&chain());
    golden_with_records("by_hand_chain", emit(&chain_system(&layout), &layout).expect("proved programs"));
}

#[test]
fn constraints_and_the_way_back_to_them() {
    let layout = layout(&rails());
    golden_with_records("by_hand_rails", emit(&rails_system(&layout), &layout).expect("proved programs"));
}

#[test]
fn a_sleigh_with_taylor_series() {
    let layout = layout(&sleigh());
    let mut system = sleigh_system(&layout);
    system.model.requests.push((Request::Taylor, system.model.origin));
    let [whole, without] =
        [&system, &sleigh_system(&layout)].map(|system| emit(system, &layout).expect("proved programs"));
    let items = |tokens: TokenStream| syn::parse2::<syn::File>(tokens).expect("a list of items").items;
    // what is asked for beyond the default
    let is_series = |item: &syn::Item| quote::quote!(#item).to_string().contains("TaylorSeries for");
    assert!(!items(without).iter().any(is_series));
    let series: Vec<syn::Item> = items(whole).into_iter().filter(is_series).collect();
    golden("by_hand_taylor", quote::quote!(#(#series)*));
}

/// What stands in the groups of some tokens.
fn groups(tokens: TokenStream) -> Vec<TokenStream> {
    let inside = |token| if let TokenTree::Group(group) = token { Some(group.stream()) } else { None };
    tokens.into_iter().filter_map(inside).collect()
}

/// A system of `tests/models` as the benchmark of record declares it: the sections, and the struct. None where the crate is built
/// without its workspace.
fn declared(name: &str) -> Option<(TokenStream, syn::ItemStruct)> {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests");
    if !tests.join("models").exists() {
        return None;
    }
    let read = |path: &str, is_it: &dyn Fn(&syn::ItemMacro) -> bool| {
        let path = tests.join(path);
        let file = syn::parse_file(&std::fs::read_to_string(path).expect("it is there")).expect("it is Rust");
        let found = file.items.into_iter().find_map(|item| match item {
            syn::Item::Macro(item) if is_it(&item) => Some(item.mac),
            _ => None,
        });
        found.expect("a macro")
    };
    // (…) => { #[nonholonomic::nonholonomic(sections $($sections)*)] $parameters };
    let rule = read("models/src/lib.rs", &|item| item.ident.as_ref().is_some_and(|ident| ident == name));
    let attribute = groups(groups(rule.tokens).swap_remove(1)).swap_remove(0);
    let mut sections: Vec<TokenTree> = groups(attribute).swap_remove(0).into_iter().collect();
    sections.truncate(sections.len() - 3);
    // struct … more sections
    let is_used =
        |item: &syn::ItemMacro| item.mac.path.segments.iter().map(|s| &s.ident).eq(["nh_models", name]);
    let used = read(&format!("bench/src/systems/{name}.rs"), &is_used);
    let rest = |input: syn::parse::ParseStream<'_>| Ok((input.parse()?, input.parse::<TokenStream>()?));
    let (item, more) = used.parse_body_with(rest).expect("a struct and more sections");
    Some((sections.into_iter().chain(more).collect(), item))
}

/// The arithmetic of the reference systems, as the benchmark of record declares them.
#[test]
fn reference_systems() {
    for name in ["sleigh", "veselova", "snakeboard", "robot", "ball"] {
        let Some((attribute, item)) = declared(name) else { return };
        let items = syn::parse2::<syn::File>(crate::expand::nonholonomic(attribute, quote::quote!(#item)));
        let is_arithmetic = |item: &syn::ImplItem| {
            let names = ["derivative", "energy", "jacobian"];
            matches!(item, syn::ImplItem::Fn(f) if names.contains(&f.sig.ident.to_string().as_str()))
        };
        let functions = items.expect("a list of items").items.into_iter().filter_map(|item| match item {
            syn::Item::Impl(mut item) if item.trait_.is_none() => {
                item.items.retain(is_arithmetic);
                (!item.items.is_empty()).then_some(item)
            }
            _ => None,
        });
        golden(name, quote::quote!(#(#functions)*));
    }
}

/// The sleigh's Jacobian without its zeros, and its products with vectors.
#[test]
fn products_with_vectors() {
    let Some((attribute, item)) = declared("sleigh") else { return };
    let attribute = attribute
        .to_string()
        .replace("{ jacobian }", "{ sparse_jacobian , jacobian_product , adjoint_product }");
    let attribute = attribute.parse().expect("tokens");
    let items = syn::parse2::<syn::File>(crate::expand::nonholonomic(attribute, quote::quote!(#item)));
    let is_product = |item: &syn::ImplItem| matches!(item, syn::ImplItem::Fn(f) if ["sparse_jacobian", "sparse_linearized", "jacobian_product", "adjoint_product"].contains(&f.sig.ident.to_string().as_str()));
    let functions = items.expect("a list of items").items.into_iter().filter_map(|item| match item {
        syn::Item::Impl(mut item) if item.trait_.is_none() => {
            item.items.retain(is_product);
            (!item.items.is_empty()).then_some(item)
        }
        _ => None,
    });
    golden("products", quote::quote!(#(#functions)*));
}

#[test]
fn stubs_stand_in() {
    let layout = layout(&sleigh());
    let outline = Outline {
        directions: Vec::new(),
        outputs: None,
        gyroscopic: Vec::new(),
        quadratures: Vec::new(),
        splitting: (0, 0),
        in_state: [layout.coordinate_symbols.as_slice(), &layout.velocity_symbols[..2]].concat(),
        requests: vec![
            Request::Jacobian,
            Request::SparseJacobian,
            Request::JacobianProduct,
            Request::AdjointProduct,
            Request::Multipliers,
            Request::Taylor,
        ],
        labels: vec![Some("blade".to_owned())],
        momenta: Vec::new(),
        identities: 0,
        velocities: 2,
        has_positions: false,
        kept: None,
        impacts: Vec::new(),
        claims_section: false,
    };
    golden_with_records("stubs", stubs(&layout, &outline));
}

/// What an impact generates beside the motion.
#[test]
fn impacts_of_a_wheel() {
    let attribute = quote::quote! {
        base { x, y, phi }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(phi)^2 - m * g * y }
        impacts { touch: y >= r, der(x) + r * der(phi) = 0 with restitution e; stop: der(phi) = 0; }
    };
    let item = quote::quote!(
        struct Wheel {
            m: f64,
            J: f64,
            g: f64,
            r: f64,
            e: f64,
        }
    );
    let items = syn::parse2::<syn::File>(crate::expand::nonholonomic(attribute, item));
    let is_about = |item: &syn::ImplItem| {
        matches!(item, syn::ImplItem::Fn(f) if {
            let name = f.sig.ident.to_string();
            name.starts_with("impact_") || name.starts_with("event_")
        })
    };
    let found = items.expect("a list of items").items.into_iter().filter_map(|item| match item {
        syn::Item::Impl(mut item) if item.trait_.is_none() => {
            item.items.retain(is_about);
            (!item.items.is_empty()).then_some(syn::Item::Impl(item))
        }
        item => quote::quote!(#item).to_string().contains("Impact").then_some(item),
    });
    let is_declaration = |item: &syn::Item| matches!(item, syn::Item::Macro(_));
    golden("impacts", found.filter(|item| !is_declaration(item)).map(|item| quote::quote!(#item)).collect());
}
