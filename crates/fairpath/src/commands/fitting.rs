//! Fitting strokes: each by itself, and many at once.

use std::panic::{AssertUnwindSafe, catch_unwind};

use anyhow::{Context, Result};
use fairpath_io::{Failure, SplineEntry, YAxis};
use fairpath_sketch::Method;
use rayon::prelude::*;

use super::fit_inputs::Job;
use super::method_options::{Fitted, Steps};
use crate::progress::Progress;
use crate::stopwatch::Stopwatch;

/// The curve of a stroke, with the times that it took if `timed`, and pictures of the steps if they are to be drawn; or why there is none.
pub(crate) fn fitted(
    job: &Job<'_>,
    method: Method,
    timed: bool,
    draw: Option<YAxis>,
) -> std::result::Result<(SplineEntry, Steps), Failure> {
    let name = job.stroke.name.as_str();
    // The fitter does not panic on data; should it all the same, the other strokes are still worth having.
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        let mut watch = Stopwatch::start();
        let fit = job.options.fit(job.stroke, &mut watch, draw);
        (fit, watch.stop())
    }));
    let (Fitted { fit, templates, steps }, ms) = match outcome {
        Ok((Ok(fitted), ms)) => (fitted, ms),
        Ok((Err(error), _)) => return Err(Failure::from_error(name, &error)),
        Err(_) => {
            let text = "the fitter broke down on this stroke, which is a mistake of ours: please report it";
            return Err(Failure { name: name.into(), code: "internal".into(), text: text.into() });
        }
    };
    let entry = SplineEntry::from_fit(name, method.name(), fit, timed.then_some(ms));
    Ok((SplineEntry { templates, ..entry }, steps))
}

/// What `one` makes of each, in their order, by so many threads; 0 is one for each processor.
///
/// # Errors
/// When there is no room for the threads.
pub(crate) fn in_parallel<J: Sync, T: Send>(
    jobs: &[J],
    threads: u16,
    one: impl Fn(&J) -> T + Send + Sync,
) -> Result<Vec<T>> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.into())
        .build()
        .with_context(|| format!("cannot start {threads} threads; ask for fewer"))?;
    let progress = Progress::start(jobs.len());
    let counted = |job: &J| {
        let made = one(job);
        progress.one_done();
        made
    };
    // `collect` keeps the order of the input, whatever the order of finishing.
    Ok(pool.install(|| jobs.par_iter().map(counted).collect()))
}
