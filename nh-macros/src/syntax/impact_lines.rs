//! The lines of `impacts`.

use proc_macro2::TokenStream;

use super::ast::{Equation, Expr, ImpactLine, ImpactRow};
use super::habits;
use super::items::END;
use super::stream::Stream;
use crate::report::Diagnostic;

/// How a line looks.
const READS: &str = "an impact reads `floor: h >= 0 with restitution e;` or `blade: u = 0, w = 0;`";

impl Stream {
    /// `label: left >= right, left = right with restitution e`
    pub(crate) fn impact_line(&mut self) -> Result<ImpactLine, Diagnostic> {
        let (_, label) = self.label()?;
        let Some(label) = label else {
            return Err(Diagnostic::new(self.whole(), "an impact without a label")
                .evidence("its label names the functions `impact_…` and `event_…`")
                .way_out(READS));
        };
        let mut rows = vec![self.impact_row()?];
        while self.eat(",") {
            if self.is_empty() || self.at_word("with") {
                break;
            }
            rows.push(self.impact_row()?);
        }
        let restitution = self.restitution()?;
        self.end(END)?;
        Ok(ImpactLine { label, rows, restitution })
    }

    /// `with restitution e`, if it is there.
    fn restitution(&mut self) -> Result<Option<Expr>, Diagnostic> {
        if self.at_word("restitution") {
            return Err(Diagnostic::new(self.here(), "`with` is missing before `restitution`").way_out(READS));
        }
        if !self.eat_word("with") {
            return Ok(None);
        }
        if !self.eat_word("restitution") {
            return Err(self.expected("`restitution`").way_out(READS));
        }
        let value = self.expression()?;
        if self.at_marks(",") {
            return Err(Diagnostic::new(self.here(), "a row behind `with restitution`")
                .evidence("one coefficient is meant for all rows of an item")
                .way_out(READS));
        }
        Ok(Some(value))
    }

    fn impact_row(&mut self) -> Result<ImpactRow, Diagnostic> {
        let start = self.position();
        let left = self.expression()?;
        let (is_unilateral, is_turned) = if self.eat(">=") {
            (true, false)
        } else if self.eat("<=") {
            (true, true)
        } else if self.at_marks(">") || self.at_marks("<") {
            return Err(Diagnostic::new(self.here(), "a gap closes where it is 0, which belongs to it")
                .way_out("write `>=` or `<=`"));
        } else if self.at_marks("=") && !self.at_marks("==") {
            self.eat("=");
            (false, false)
        } else {
            return Err(habits::unexpected(self, "`>=` or `=`").or_way_out(READS));
        };
        let right = self.expression()?;
        let sides =
            Equation { docs: TokenStream::new(), label: None, left, right, extent: self.since(start) };
        Ok(ImpactRow { sides, is_unilateral, is_turned })
    }
}
