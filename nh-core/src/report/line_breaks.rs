//! Where lines that are too long are broken: before signs that stand outside of as many brackets as possible.

/// What a line is made of: it can be broken before every piece but the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Extent {
    /// How wide it is, in any unit.
    pub width: usize,
    /// The brackets around the place before it.
    pub depth: usize,
}

/// How many pieces stand on a line with so much room: as many as fit before the last of the outermost places, or else up
/// to the first place.
#[must_use]
pub fn first_line(pieces: &[Extent], room: usize) -> usize {
    if pieces.iter().map(|piece| piece.width).sum::<usize>() <= room {
        return pieces.len();
    }
    let mut best: Option<(usize, usize)> = None;
    let mut end = 0;
    for (index, pair) in pieces.windows(2).enumerate() {
        let [before, after] = pair else { continue };
        end += before.width;
        if end > room && best.is_some() {
            break;
        }
        if best.is_none_or(|(least, _)| after.depth <= least) {
            best = Some((after.depth, index + 1));
        }
    }
    best.map_or(pieces.len(), |(_, count)| count)
}
