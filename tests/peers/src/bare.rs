//! No library: methods as one unrolled loop each, written for these runs. The yardstick.

use crate::problem::Problem;

/// The classical Runge–Kutta method with `steps` steps.
pub fn rk4<const N: usize, P: Problem<N>>(system: &P, start: [f64; N], steps: u32) -> [f64; N] {
    let h = P::END / f64::from(steps);
    let mut x = start;
    for step in 0..steps {
        let t = f64::from(step) * h;
        let at = |c: f64, k: &[f64; N]| -> [f64; N] { std::array::from_fn(|i| c.mul_add(k[i], x[i])) };
        let k1 = system.rate(t, &x);
        let k2 = system.rate(t + h / 2.0, &at(h / 2.0, &k1));
        let k3 = system.rate(t + h / 2.0, &at(h / 2.0, &k2));
        let k4 = system.rate(t + h, &at(h, &k3));
        for i in 0..N {
            x[i] = (h / 6.0).mul_add(2.0f64.mul_add(k2[i] + k3[i], k1[i] + k4[i]), x[i]);
        }
    }
    x
}

/// The method of Dormand and Prince of order 8 with the plainest control of its steps.
pub fn dop853<const N: usize, P: Problem<N>>(
    system: &P,
    start: [f64; N],
    tolerance: f64,
) -> Option<[f64; N]> {
    macro_rules! sum {
        ($($c:literal $k:ident),*) => {
            std::array::from_fn::<f64, N, _>(|i| { let mut s = 0.0f64; $(s = f64::mul_add($c, $k[i], s);)* s })
        };
    }
    let (mut t, mut x, mut h) = (0.0, start, 0.1_f64);
    let mut k1 = system.rate(t, &x);
    for _ in 0..1_000_000 {
        let last = t + 1.000_001 * h >= P::END;
        if last {
            h = P::END - t;
        }
        macro_rules! stage {
            ($at:literal: $($c:literal $k:ident),*) => {{
                let s = sum!($($c $k),*);
                system.rate(t + $at * h, &std::array::from_fn(|i| h.mul_add(s[i], x[i])))
            }};
        }
        let k2 = stage!(0.05260015195876773: 0.05260015195876773 k1);
        let k3 = stage!(0.0789002279381516: 0.0197250569845379 k1, 0.0591751709536137 k2);
        let k4 = stage!(0.1183503419072274: 0.02958758547680685 k1, 0.08876275643042054 k3);
        let k5 =
            stage!(0.2816496580927726: 0.2413651341592667 k1, -0.8845494793282861 k3, 0.924834003261792 k4);
        let k6 = stage!(0.3333333333333333: 0.037037037037037035 k1, 0.17082860872947386 k4, 0.12546768756682242 k5);
        let k7 =
            stage!(0.25: 0.037109375 k1, 0.17025221101954405 k4, 0.06021653898045596 k5, -0.017578125 k6);
        let k8 = stage!(0.3076923076923077: 0.03709200011850479 k1, 0.17038392571223998 k4, 0.10726203044637328 k5,
            -0.015319437748624402 k6, 0.008273789163814023 k7);
        let k9 = stage!(0.6512820512820513: 0.6241109587160757 k1, -3.3608926294469414 k4, -0.868219346841726 k5,
            27.59209969944671 k6, 20.154067550477894 k7, -43.48988418106996 k8);
        let k10 = stage!(0.6: 0.47766253643826434 k1, -2.4881146199716677 k4, -0.590290826836843 k5,
            21.230051448181193 k6, 15.279233632882423 k7, -33.28821096898486 k8, -0.020331201708508627 k9);
        let k11 = stage!(0.8571428571428571: -0.9371424300859873 k1, 5.186372428844064 k4, 1.0914373489967295 k5,
            -8.149787010746927 k6, -18.52006565999696 k7, 22.739487099350505 k8, 2.4936055526796523 k9,
            -3.0467644718982196 k10);
        let k12 = stage!(1.0: 2.273310147516538 k1, -10.53449546673725 k4, -2.0008720582248625 k5,
            -17.9589318631188 k6, 27.94888452941996 k7, -2.8589982771350235 k8, -8.87285693353063 k9,
            12.360567175794303 k10, 0.6433927460157636 k11);
        let slope = sum!(0.054293734116568765 k1, 4.450312892752409 k6, 1.8915178993145003 k7,
            -5.801203960010585 k8, 0.3111643669578199 k9, -0.1521609496625161 k10, 0.20136540080403034 k11,
            0.04471061572777259 k12);
        let fifth = sum!(0.01312004499419488 k1, -1.2251564463762044 k6, -0.4957589496572502 k7,
            1.6643771824549864 k8, -0.35032884874997366 k9, 0.3341791187130175 k10, 0.08192320648511571 k11,
            -0.022355307863886294 k12);
        let third = sum!(-0.18980075407240762 k1, 4.450312892752409 k6, 1.8915178993145003 k7,
            -5.801203960010585 k8, -0.42268232132379197 k9, -0.1521609496625161 k10, 0.20136540080403034 k11,
            0.022651792198360825 k12);
        let end: [f64; N] = std::array::from_fn(|i| h.mul_add(slope[i], x[i]));
        let (mut e5, mut e3) = (0.0, 0.0);
        for i in 0..N {
            let weight = 1.0 / tolerance.mul_add(x[i].abs().max(end[i].abs()), tolerance);
            e5 += (fifth[i] * weight) * (fifth[i] * weight);
            e3 += (third[i] * weight) * (third[i] * weight);
        }
        let sum = 0.01f64.mul_add(e3, e5);
        #[allow(clippy::cast_precision_loss)]
        let error = if sum == 0.0 { 0.0 } else { h * e5 / (sum * N as f64).sqrt() };
        if error <= 1.0 {
            (t, x) = (t + h, end);
            if last {
                return Some(x);
            }
            k1 = system.rate(t, &x);
        }
        if !error.is_finite() {
            return None;
        }
        // 0.9 error^(-1/8), between 0.2 and 6
        h *= (0.9 / error.sqrt().sqrt().sqrt()).clamp(0.2, 6.0);
    }
    None
}
