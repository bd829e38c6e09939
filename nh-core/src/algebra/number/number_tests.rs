use super::*;

#[test]
fn stays_reduced_and_small_when_it_can() {
    assert_eq!(Rational::new(6, -4), Rational::new(-3, 2));
    let large = Rational::from(i64::MAX) * Rational::from(i64::MAX);
    let back = large.clone() * large.recip().unwrap() * Rational::from(7);
    assert_eq!(back, Rational::from(7));
    assert_eq!(Rational::from(i64::MIN).abs().to_string(), "9223372036854775808");
}

#[test]
fn overflow_of_the_fast_path_is_exact() {
    let a = Rational::new(i64::MAX, i64::MAX - 1);
    let b = Rational::new(i64::MAX - 2, i64::MAX - 3);
    let sum = a.clone() + b.clone();
    assert_eq!(sum - b, a);
}

#[test]
fn conversion_rounds_to_nearest() {
    let tenth = Rational::from_big(BigInt::from(10).pow(40u32), BigInt::from(10).pow(41u32)).unwrap();
    assert_eq!(tenth.to_f64().to_bits(), 0.1f64.to_bits());
    let long: BigInt = "314159265358979323846264338327950288".parse().unwrap();
    let pi = Rational::from_big(long, BigInt::from(10).pow(35u32)).unwrap();
    assert_eq!(pi.to_f64().to_bits(), std::f64::consts::PI.to_bits());
    let huge = Rational::from(10).pow(400).unwrap();
    assert!(huge.to_f64().is_infinite());
    assert!(huge.recip().unwrap().to_f64() == 0.0);
}

#[test]
fn powers_and_roots() {
    assert_eq!(Rational::new(2, 3).pow(-3), Some(Rational::new(27, 8)));
    assert_eq!(Rational::ZERO.pow(-1), None);
    assert_eq!(Rational::from(10).pow(1_000_000), None);
    assert_eq!(Rational::new(9, 4).sqrt(), Some(Rational::new(3, 2)));
    assert_eq!(
        Rational::from(i64::MIN).pow(2).unwrap().to_string(),
        "85070591730234615865843651857942052864"
    );
    assert_eq!(Rational::from(i64::MAX).sqrt(), None);
    assert_eq!(Rational::from(2).sqrt(), None);
    assert_eq!(Rational::new(4, 3).gcd(&Rational::new(2, 9)), Rational::new(2, 9));
    assert_eq!(Rational::new(-3, 2).gcd(&Rational::ZERO), Rational::new(3, 2));
    let huge = Rational::new(i64::MAX, 2);
    assert_eq!(huge.gcd(&Rational::new(i64::MAX, 3)), Rational::new(i64::MAX, 6));
}
