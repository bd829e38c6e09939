//! Serialization of generated states, for the crates that ask for it: whether the `serde` feature
//! is on is known here, not where the code is generated.

/// `Serialize` and `Deserialize` for a generated struct of numbers, through a mirror of it in a
/// module of its own, where no name of the user's can get in the way of the derives.
#[cfg(feature = "serde")]
#[doc(hidden)]
#[macro_export]
macro_rules! __nh_serde_impls {
    ($path:literal, $text:literal, { $(#[$allow:meta])* } $name:ident [$(<$t:ident>)?] {
        $($field:ident: $type:ty,)*
    }) => {
        $(#[$allow])*
        const _: () = {
            mod mirror {
                #[derive($crate::__private::serde::Serialize, $crate::__private::serde::Deserialize)]
                #[serde(crate = $path, rename = $text, expecting = $text)]
                pub(super) struct Mirror $(<$t>)? { $(pub(super) $field: $type,)* }
            }
            #[automatically_derived]
            impl $(<$t: $crate::Scalar + $crate::__private::serde::Serialize>)?
                $crate::__private::serde::Serialize for $name $(<$t>)?
            {
                fn serialize<__S: $crate::__private::serde::Serializer>(
                    &self,
                    serializer: __S,
                ) -> $crate::__private::core::result::Result<__S::Ok, __S::Error> {
                    let mirror = mirror::Mirror { $($field: self.$field,)* };
                    $crate::__private::serde::Serialize::serialize(&mirror, serializer)
                }
            }
            #[automatically_derived]
            impl<'de $(, $t: $crate::Scalar + $crate::__private::serde::Deserialize<'de>)?>
                $crate::__private::serde::Deserialize<'de> for $name $(<$t>)?
            {
                fn deserialize<__D: $crate::__private::serde::Deserializer<'de>>(
                    deserializer: __D,
                ) -> $crate::__private::core::result::Result<Self, __D::Error> {
                    let mirror = <mirror::Mirror $(<$t>)? as
                        $crate::__private::serde::Deserialize<'de>>::deserialize(deserializer)?;
                    $crate::__private::core::result::Result::Ok(Self { $($field: mirror.$field,)* })
                }
            }
        };
    };
}

/// Nothing: the `serde` feature is off.
#[cfg(not(feature = "serde"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __nh_serde_impls {
    ($($tokens:tt)*) => {};
}
