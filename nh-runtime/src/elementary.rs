//! The elementary functions of `f32` and `f64`, from the platform or from `libm`.

/// Defines one module of elementary functions per scalar type. Each line gives the name, and how
/// the platform and `libm` call it.
macro_rules! elementary {
    ($module:ident, $float:ty; $($name:ident($($argument:ident),+) = $std:ident, $libm:ident;)*) => {
        pub(crate) mod $module {
            $(
                #[inline]
                pub(crate) fn $name($($argument: $float),+) -> $float {
                    elementary!(@call $float, $std, $libm, $($argument),+)
                }
            )*
        }
    };
    (@call $float:ty, $std:ident, $libm:ident, $first:ident $(, $rest:ident)*) => {{
        #[cfg(feature = "std")]
        {
            <$float>::$std($first $(, $rest)*)
        }
        #[cfg(all(not(feature = "std"), feature = "libm"))]
        {
            libm::$libm($first $(, $rest)*)
        }
        // Neither: lib.rs has already refused to compile. This only keeps its message alone.
        #[cfg(not(any(feature = "std", feature = "libm")))]
        {
            $(let _ = $rest;)*
            $first
        }
    }};
}

elementary! { double, f64;
    sqrt(x) = sqrt, sqrt;
    cbrt(x) = cbrt, cbrt;
    sin(x) = sin, sin;
    cos(x) = cos, cos;
    tan(x) = tan, tan;
    asin(x) = asin, asin;
    acos(x) = acos, acos;
    atan(x) = atan, atan;
    atan2(y, x) = atan2, atan2;
    sinh(x) = sinh, sinh;
    cosh(x) = cosh, cosh;
    tanh(x) = tanh, tanh;
    exp(x) = exp, exp;
    ln(x) = ln, log;
    powf(x, y) = powf, pow;
}

elementary! { single, f32;
    sqrt(x) = sqrt, sqrtf;
    cbrt(x) = cbrt, cbrtf;
    tan(x) = tan, tanf;
    asin(x) = asin, asinf;
    acos(x) = acos, acosf;
    atan(x) = atan, atanf;
    atan2(y, x) = atan2, atan2f;
    sinh(x) = sinh, sinhf;
    cosh(x) = cosh, coshf;
    tanh(x) = tanh, tanhf;
    exp(x) = exp, expf;
    ln(x) = ln, logf;
    powf(x, y) = powf, powf;
}

/// Sine and cosine of `f32`: from the platform, or from the runtime's own kernel, which computes in
/// single precision alone where `libm` computes in double precision.
pub(crate) mod single_angle {
    /// Sine and cosine.
    #[inline]
    pub(crate) fn sin_cos(x: f32) -> (f32, f32) {
        #[cfg(feature = "std")]
        {
            x.sin_cos()
        }
        #[cfg(not(feature = "std"))]
        {
            crate::sine::sin_cos(x)
        }
    }

    /// The sine.
    #[inline]
    pub(crate) fn sin(x: f32) -> f32 {
        sin_cos(x).0
    }

    /// The cosine.
    #[inline]
    pub(crate) fn cos(x: f32) -> f32 {
        sin_cos(x).1
    }
}

/// Sine and cosine of `f64`.
pub(crate) mod double_angle {
    pub(crate) use super::double::{cos, sin};

    /// Sine and cosine.
    #[inline]
    pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
        #[cfg(feature = "std")]
        {
            x.sin_cos()
        }
        #[cfg(all(not(feature = "std"), feature = "libm"))]
        {
            libm::sincos(x)
        }
        #[cfg(not(any(feature = "std", feature = "libm")))]
        {
            (x, x)
        }
    }
}
