//! How long each step of a fit took: the library reads no clock, so the caller does.

use std::time::Instant;

use fairpath_fit::{Observer, Step};
pub use fairpath_io::Milliseconds;

/// An [`Observer`] with a clock.
#[derive(Debug)]
pub struct Stopwatch {
    begun: Instant,
    step: Option<(Step, Instant)>,
    ms: Milliseconds,
}

impl Stopwatch {
    /// Starts.
    #[must_use]
    pub fn start() -> Self {
        Self { begun: Instant::now(), step: None, ms: Milliseconds::default() }
    }

    /// Stops and says how long each step took.
    #[must_use]
    pub fn stop(mut self) -> Milliseconds {
        self.end_step();
        self.ms.total = ms_since(self.begun);
        self.ms
    }

    fn end_step(&mut self) {
        let Some((step, since)) = self.step.take() else { return };
        // Steps may come more than once, when a fallback starts anew, so times add up.
        match step {
            Step::Preprocess => self.ms.preprocess += ms_since(since),
            Step::Candidates => self.ms.candidates += ms_since(since),
            Step::Graph => self.ms.graph += ms_since(since),
            Step::Search => self.ms.search += ms_since(since),
            Step::Merge => self.ms.merge += ms_since(since),
            Step::Done => {}
        }
    }
}

impl Observer for Stopwatch {
    fn step(&mut self, step: Step) {
        self.end_step();
        self.step = Some((step, Instant::now()));
    }
}

fn ms_since(instant: Instant) -> f64 {
    instant.elapsed().as_secs_f64() * 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_steps_add_up_to_no_more_than_the_total() {
        let mut watch = Stopwatch::start();
        for step in
            [Step::Preprocess, Step::Candidates, Step::Graph, Step::Search, Step::Merge, Step::Search, Step::Done]
        {
            watch.step(step);
            std::hint::black_box((0..10_000).sum::<u64>());
        }
        let ms = watch.stop();
        let sum = ms.preprocess + ms.candidates + ms.graph + ms.search + ms.merge;
        assert!(sum > 0.0 && sum <= ms.total, "{ms:?}");
    }
}
