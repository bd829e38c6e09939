//! Motions as they are stored: a sequence of steps, each the times of its ends and the states at its nodes.

use core::fmt;
use core::marker::PhantomData;

use serde::de::{Error, SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Buffer, Segment, Trajectory};
use crate::{Real, Scalar, State};

impl<X, const P: usize> Serialize for Segment<X, P>
where
    X: State + Serialize,
    X::Scalar: Serialize,
{
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        let mut tuple = serializer.serialize_tuple(P + 2)?;
        tuple.serialize_element(&self.from)?;
        tuple.serialize_element(&self.to)?;
        for node in &self.nodes {
            tuple.serialize_element(node)?;
        }
        tuple.end()
    }
}

impl<'de, X, const P: usize> Deserialize<'de> for Segment<X, P>
where
    X: State + Deserialize<'de>,
    X::Scalar: Real + Deserialize<'de>,
{
    fn deserialize<R: Deserializer<'de>>(deserializer: R) -> Result<Self, R::Error> {
        deserializer.deserialize_tuple(P + 2, SegmentVisitor(PhantomData))
    }
}

struct SegmentVisitor<X, const P: usize>(PhantomData<X>);

impl<'de, X, const P: usize> Visitor<'de> for SegmentVisitor<X, P>
where
    X: State + Deserialize<'de>,
    X::Scalar: Real + Deserialize<'de>,
{
    type Value = Segment<X, P>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the times of the ends of a step and {P} states")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut parts: A) -> Result<Self::Value, A::Error> {
        let from = parts.next_element()?.ok_or_else(|| A::Error::invalid_length(0, &self))?;
        let to = parts.next_element()?.ok_or_else(|| A::Error::invalid_length(1, &self))?;
        let mut segment = Segment { from, to, ..Segment::default() };
        for (index, node) in segment.nodes.iter_mut().enumerate() {
            *node = parts.next_element()?.ok_or_else(|| A::Error::invalid_length(index + 2, &self))?;
        }
        Ok(segment)
    }
}

impl<X, B, const P: usize> Serialize for Trajectory<X, B, P>
where
    X: State + Serialize,
    X::Scalar: Real + Serialize,
    B: Buffer<Segment<X, P>>,
{
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        serializer.collect_seq(self.segments())
    }
}

/// Into a buffer that begins empty: a `Vec`.
impl<'de, X, B, const P: usize> Deserialize<'de> for Trajectory<X, B, P>
where
    X: State + Deserialize<'de>,
    X::Scalar: Real + Deserialize<'de>,
    B: Buffer<Segment<X, P>> + Default,
{
    fn deserialize<R: Deserializer<'de>>(deserializer: R) -> Result<Self, R::Error> {
        deserializer.deserialize_seq(TrajectoryVisitor(PhantomData))
    }
}

struct TrajectoryVisitor<X, B, const P: usize>(PhantomData<(X, B)>);

impl<'de, X, B, const P: usize> Visitor<'de> for TrajectoryVisitor<X, B, P>
where
    X: State + Deserialize<'de>,
    X::Scalar: Real + Deserialize<'de>,
    B: Buffer<Segment<X, P>> + Default,
{
    type Value = Trajectory<X, B, P>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("steps that follow one another")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut steps: A) -> Result<Self::Value, A::Error> {
        let mut motion = Trajectory::new(B::default());
        while let Some(segment) = steps.next_element::<Segment<X, P>>()? {
            let (from, to) = (segment.from, segment.to);
            if !(from.is_finite() && to.is_finite()) || from == to {
                return Err(A::Error::custom("a step has a beginning and an end, which are two times"));
            }
            motion.keep(segment).map_err(A::Error::custom)?;
        }
        Ok(motion)
    }
}

#[cfg(test)]
mod tests {
    use std::string::ToString;
    use std::vec::Vec;

    use crate::{D, Segment, State, Trajectory};

    #[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
    struct Point {
        x: f64,
        y: f64,
    }

    impl State for Point {
        type Scalar = f64;
        type Dim = D<2>;
        fn to_array(&self) -> [f64; 2] {
            [self.x, self.y]
        }
        fn from_array([x, y]: [f64; 2]) -> Self {
            Self { x, y }
        }
        fn names() -> [&'static str; 2] {
            ["x", "y"]
        }
    }

    type Stored = Trajectory<Point, Vec<Segment<Point, 3>>, 3>;

    fn step(from: f64, to: f64) -> Segment<Point, 3> {
        Segment::new(from, to, [from, 0.5 * (from + to), to].map(|t| Point { x: t, y: t * t / 3.0 }))
    }

    #[test]
    fn what_is_read_is_what_was_stored() {
        let mut motion = Stored::new(Vec::new());
        for i in 0..5 {
            motion.keep(step(0.1 * f64::from(i), 0.1 * f64::from(i + 1))).unwrap();
        }
        let text = serde_json::to_string(&motion).unwrap();
        let read: Stored = serde_json::from_str(&text).unwrap();
        assert_eq!(read.len(), 5);
        for i in 0..=50 {
            let t = 0.01 * f64::from(i);
            assert_eq!(read.at(t), motion.at(t));
        }
        assert_eq!(read.at(0.25), motion.at(0.25));
        assert!((read.at(0.25).unwrap().y - 0.0625 / 3.0).abs() < 1e-16);
    }

    #[test]
    fn steps_that_do_not_follow_one_another_are_refused() {
        let steps = |steps: &[Segment<Point, 3>]| serde_json::to_string(steps).unwrap();
        let refused = |text: &str| serde_json::from_str::<Stored>(text).unwrap_err().to_string();
        let gap = refused(&steps(&[step(0.0, 1.0), step(2.0, 3.0)]));
        assert!(gap.starts_with("the kept motion ends at t = 1.0, and the run begins at 2.0"), "{gap}");
        let turn = refused(&steps(&[step(0.0, 1.0), step(1.0, 0.5)]));
        assert!(turn.starts_with("the run turns back at t = 1.0"), "{turn}");
        let none = refused(&steps(&[step(1.0, 1.0)]));
        assert!(none.starts_with("a step has a beginning and an end, which are two times"), "{none}");
        let short = refused(r#"[[0.0, 1.0, {"x": 1.0, "y": 2.0}]]"#);
        assert!(short.contains("the times of the ends of a step and 3 states"), "{short}");
    }
}
