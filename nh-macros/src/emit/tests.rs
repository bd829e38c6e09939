//! Emitted code against golden files: `UPDATE_GOLDEN=1 cargo test -p nh-macros` writes them anew.

use nh_core::model::Request;
use proc_macro2::TokenStream;

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

#[test]
fn a_sleigh() {
    let layout = layout(&sleigh());
    golden("by_hand_sleigh", emit(&sleigh_system(&layout), &layout));
}

#[test]
fn families_and_a_type_parameter() {
    let layout = layout(&chain());
    golden("by_hand_chain", emit(&chain_system(&layout), &layout));
}

#[test]
fn constraints_and_the_way_back_to_them() {
    let layout = layout(&rails());
    golden("by_hand_rails", emit(&rails_system(&layout), &layout));
}

#[test]
fn a_sleigh_with_taylor_series() {
    let layout = layout(&sleigh());
    let mut system = sleigh_system(&layout);
    system.model.requests.push((Request::Taylor, system.model.origin));
    let (whole, without) = (emit(&system, &layout), emit(&sleigh_system(&layout), &layout));
    let items = |tokens: TokenStream| syn::parse2::<syn::File>(tokens).expect("a list of items").items;
    // what is asked for beyond the default
    let is_series = |item: &syn::Item| quote::quote!(#item).to_string().contains("TaylorSeries for");
    assert!(!items(without).iter().any(is_series));
    let series: Vec<syn::Item> = items(whole).into_iter().filter(is_series).collect();
    golden("by_hand_taylor", quote::quote!(#(#series)*));
}

#[test]
fn stubs_stand_in() {
    let layout = layout(&sleigh());
    let outline = Outline {
        in_state: [layout.coordinate_symbols.as_slice(), &layout.velocity_symbols[..2]].concat(),
        requests: vec![Request::Jacobian, Request::Multipliers, Request::Taylor],
        labels: vec![Some("blade".to_owned())],
        momenta: Vec::new(),
        identities: 0,
        velocities: 2,
        claims_section: false,
    };
    golden("stubs", stubs(&layout, &outline));
}
