//! The reference systems, as they stand in their files, pass the stages up to here and the engine.

use std::path::Path;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::{super::Resolved, resolve};
use crate::emit::Layout;
use crate::syntax;

/// The declarations in a file, also those inside macros: attribute and struct.
fn declarations(tokens: TokenStream) -> Vec<(TokenStream, TokenStream)> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut found = Vec::new();
    for (k, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let mut inside = group.stream().into_iter();
        let attribute = match (inside.next(), inside.next()) {
            (Some(TokenTree::Ident(word)), Some(TokenTree::Group(attribute))) if word == "nonholonomic" => {
                attribute
            }
            _ => {
                found.extend(declarations(group.stream()));
                continue;
            }
        };
        let is_body = |token: &&TokenTree| match token {
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
            TokenTree::Punct(mark) => mark.as_char() == ';',
            _ => false,
        };
        let end = k + 1 + tokens[k + 1..].iter().position(|token| is_body(&token)).expect("a struct");
        found.push((attribute.stream(), tokens[k + 1..=end].iter().cloned().collect()));
    }
    found
}

pub(super) fn resolved(attribute: TokenStream, item: TokenStream) -> Resolved {
    let declaration = syntax::parse(attribute.clone(), item).expect("well-formed");
    let mut layout = Layout::of_struct(&declaration.structure, attribute);
    resolve(&declaration, &mut layout).expect("resolved")
}

/// Every declaration of the catalogue; none where the crate is built without its workspace.
pub(super) fn all() -> Vec<(TokenStream, TokenStream)> {
    in_folder(Path::new("../tests/src/systems"))
}

/// Every declaration in the files of a folder, beside the crate.
pub(super) fn in_folder(folder: &Path) -> Vec<(TokenStream, TokenStream)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let Ok(files) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "rs"));
    paths.sort();
    let text = |path| std::fs::read_to_string(path).expect("text");
    paths.iter().flat_map(|path| declarations(text(path).parse().expect("tokens"))).collect()
}

#[test]
fn the_reference_systems_are_understood() {
    let all = all();
    assert!(all.is_empty() || all.len() >= 25, "{} systems", all.len());
    for (attribute, item) in all {
        let system = resolved(attribute, item);
        let name = system.model.name.clone();
        if let Err(violations) = nonholonomic_core::compile::compile(system.model) {
            panic!("{name}: {violations:?}");
        }
    }
}
