//! What a method that is made of another one leaves to that.

/// The functions of [`Method`](super::Method) that `self.method` is asked for as it is, with its own memory in the field
/// `method` of the memory. What else stands there ends with the input (`forget`) or with the state alone (`restart`): the
/// fields, and the values that they then have.
macro_rules! handed_on {
    (
        forget { $($forgotten:ident = $none:expr)? }
        restart { $($dropped:ident = $value:expr)? }
        keeps_positions { |$this:ident| $keeps:expr }
        $(interpolated { |$start:ident, $time:ident, $state:ident| $moved:expr })?
    ) => {
        type Dense = M::Dense;

        #[inline]
        fn forget(&self, memory: &mut Self::Memory) {
            self.method.forget(&mut memory.method);
            $(memory.$forgotten = $none;)?
        }

        fn restart(&self, memory: &mut Self::Memory) {
            self.method.restart(&mut memory.method);
            $(memory.$forgotten = $none;)?
            $(memory.$dropped = $value;)?
        }

        #[inline]
        fn moved(&self, memory: &mut Self::Memory) {
            self.method.moved(&mut memory.method);
        }

        fn stand(&self, memory: &mut Self::Memory) {
            self.method.stand(&mut memory.method);
        }

        #[inline]
        fn keeps_positions(&self) -> bool {
            let $this = self;
            $keeps
        }

        #[inline]
        fn judges(&self) -> bool {
            self.method.judges()
        }

        fn permitted(&self, state: &S::State) -> VecOf<S>
        where
            ScalarOf<S>: Real,
        {
            self.method.permitted(state)
        }

        #[inline]
        fn dense(&self, memory: &Self::Memory, start: &Start<'_, S>, arrival: &Arrival<S>) -> M::Dense {
            self.method.dense(&memory.method, start, arrival)
        }

        #[inline]
        fn interpolate(
            &self,
            dense: &M::Dense,
            start: &Start<'_, S>,
            arrival: &Arrival<S>,
            time: ScalarOf<S>,
        ) -> S::State {
            let state = self.method.interpolate(dense, start, arrival, time);
            $(
                let ($start, $time, mut $state) = (start, time, state);
                let state = $moved;
            )?
            state
        }
    };
}
