//! Tests of reading the struct.

use quote::ToTokens;

use super::ast::Scalar;
use super::testing::{declaration, messages};

const ENOUGH: &str = "base { x } lagrangian { x }";

fn refused(item: &str) -> Vec<String> {
    messages(ENOUGH, item)
}

#[test]
fn parameters_are_scalars_and_arrays() {
    let read = declaration(
        ENOUGH,
        "/// A body.\n pub(crate) struct Body<'a, T: Copy> where T: Send {
            /// mass\n pub m: T, I: [T; 3], A: [[T; 3]; 2], #[nh(skip)] name: &'a str,
            #[cfg_attr(feature = \"serde\", serde(skip))] r#type: (T),
         }",
    )
    .expect("a declaration");
    let structure = read.structure;
    assert!(matches!(&structure.scalar, Scalar::Parameter(name) if name == "T"));
    assert_eq!(structure.visibility.to_token_stream().to_string(), "pub (crate)");
    assert_eq!(structure.generics.params.len(), 2);
    let found: Vec<_> =
        structure.parameters.iter().map(|p| (p.name.text.as_str(), p.lengths.as_slice())).collect();
    assert_eq!(found, [("m", [].as_slice()), ("I", &[3]), ("A", &[2, 3]), ("type", &[])]);
    assert_eq!(structure.parameters[0].docs.to_string(), "# [doc = \" mass\"]");
    assert_eq!(structure.skipped[0].text, "name");
    let item = structure.item.to_string();
    assert!(!item.contains("nh") && item.contains("cfg_attr") && item.contains("A body"), "{item}");
}

#[test]
fn without_parameters_the_scalar_is_f64() {
    for item in ["struct S;", "struct S {}", "pub struct S<T> { #[nh(skip)] t: PhantomData<T> }"] {
        let read = declaration(ENOUGH, item).expect("a declaration");
        assert_eq!(read.structure.scalar.word(), "f64");
    }
    let read = declaration(ENOUGH, "struct S { m: f32 }").expect("a declaration");
    assert_eq!(read.structure.scalar.word(), "f32");
}

#[test]
fn other_items_are_refused() {
    let way_out = "help: `#[nonholonomic]` stands before the struct of the parameters: \
                   `struct Sleigh { m: f64, a: f64 }`";
    for (item, what) in [
        ("enum E { A }", "`enum` is no struct"),
        ("pub union U { a: f64 }", "`union` is no struct"),
        ("fn f() {}", "`fn` is no struct"),
        ("impl S { fn struct_() {} }", "`impl` is no struct"),
        ("", "this is no struct"),
    ] {
        assert_eq!(refused(item), [format!("{what}\n{way_out}")], "{item}");
    }
    assert_eq!(
        refused("struct S(f64);"),
        ["the fields of this struct have no names\nhelp: parameters are named: \
          `struct Sleigh { m: f64, a: f64 }`"]
    );
    assert_eq!(refused("struct S { m f64 }").len(), 1);
}

#[test]
fn fields_of_other_types_are_refused() {
    for (fields, message) in [
        (
            "m: usize",
            "`usize` is not the type of a parameter\nhelp: parameters are `f64`, `f32` or a type \
             parameter, or arrays of it; a field marked `#[nh(skip)]` is left alone",
        ),
        (
            "m: Vec<f64>",
            "`Vec<f64>` is not the type of a parameter\nhelp: parameters are `f64`, `f32` or a type \
             parameter, or arrays of it; a field marked `#[nh(skip)]` is left alone",
        ),
        (
            "m: f64, J: [f32; 3]",
            "the parameters are of two scalar types\n`m` is made of `f64`, `J` of `f32`\nhelp: give them \
             the same type",
        ),
        (
            "m: [f64; N]",
            "the length of a parameter array must be written as a number\nconstants are evaluated only \
             after the equations are derived\nhelp: write `[f64; 3]`",
        ),
        ("m: [[[f64; 2]; 2]; 2]", "an array of more than two indices\nhelp: use several fields"),
        ("m: [f64; 0]", "this has no entries\nhelp: leave it out"),
        ("m: [[f64; 65]; 65]", "this has more than 4096 entries"),
        (
            "#[cfg(unix)] m: f64",
            "a parameter cannot depend on `cfg`\nthe declaration is read before the compiler decides \
             which fields there are\nhelp: put the `#[cfg]` on the whole struct, and write one struct \
             for each case",
        ),
        (
            "#[nh(ignore)] m: f64",
            "unknown attribute of a field\nhelp: write `#[nh(skip)]`, which leaves the field alone, or `#[nh(symmetric)]` before a \
             square matrix",
        ),
    ] {
        assert_eq!(refused(&format!("struct S {{ {fields} }}")), [message], "{fields}");
    }
    assert_eq!(refused("struct S { a: u8, b: f64, c: f32 }").len(), 2);
}

#[test]
fn generics_that_cannot_work_are_refused() {
    assert_eq!(
        refused("struct S<const N: usize>;"),
        [
            "const parameters are not supported\nhelp: the equations are derived for fixed sizes: write the number"
        ]
    );
    // whatever has that length is not said to be wrong as well
    assert_eq!(
        refused("struct S<const N: usize> { a: [f64; N], b: [[f64; 2]; { N + 1 }], c: u8 }"),
        [
            "const parameters are not supported\nhelp: the equations are derived for fixed sizes: write the number",
            "`u8` is not the type of a parameter\nhelp: parameters are `f64`, `f32` or a type parameter, or arrays of \
             it; a field marked `#[nh(skip)]` is left alone"
        ]
    );
    assert_eq!(
        refused("#[nh(skip)] struct S;"),
        ["`nh` attributes belong to fields\nhelp: `#[nh(skip)]` before a field leaves that field alone"]
    );
}
