//! Numbers in print, to the last bit.

/// A number that is printed by its bits.
pub(crate) trait Bits: Copy {
    /// The bits, in hexadecimal digits.
    fn bits(self) -> String;
}

impl Bits for f64 {
    fn bits(self) -> String {
        format!("{:016x}", self.to_bits())
    }
}

impl Bits for f32 {
    fn bits(self) -> String {
        format!("{:08x}", self.to_bits())
    }
}

/// The type of numbers, a name, and their bits.
pub(crate) fn line<T: Bits>(name: &str, numbers: &[T]) -> String {
    let words: Vec<String> = numbers.iter().map(|x| x.bits()).collect();
    format!("{} {name:20} {}", std::any::type_name::<T>(), words.join(" "))
}
