//! Declarations are found in source text.

use nh_stages::declarations;

#[test]
fn wherever_they_stand() {
    let source =
        "mod inner { /// A point.\n #[derive(Clone)] #[nonholonomic(base { x })] pub struct A { m: f64 } }
        fn f() { #[nonholonomic::nonholonomic(base { y })] struct B {} } #[derive(Clone)] struct C;";
    let found = declarations(source);
    let names: Vec<&str> = found.iter().map(|declaration| declaration.name.as_str()).collect();
    assert_eq!(names, ["A", "B"]);
    assert!(found[0].item.to_string().contains("derive"), "{}", found[0].item);
    assert_eq!(found[1].attribute.to_string(), "base { y }");
}

#[test]
fn they_are_derived_or_refused() {
    let source = "#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 })] struct Point { m: f64 }
        #[nonholonomic(base { x } lagrangian { m * x })] struct Massless { m: f64 }";
    let found = declarations(source);
    assert!(found[0].system().unwrap().report.starts_with("Point\n"));
    assert!(found[1].system().unwrap_err()[0].contains("mass matrix"));
}
