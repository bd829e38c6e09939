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
        let mut segment = Segment::default();
        segment.from = parts.next_element()?.ok_or_else(|| A::Error::invalid_length(0, &self))?;
        segment.to = parts.next_element()?.ok_or_else(|| A::Error::invalid_length(1, &self))?;
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
