//! The desktop's window under test: a screen that is none, the program on it, hands that draw and pictures of what is seen.

mod hands;
mod picture;
mod program;
mod screen;
mod strokes;

use std::time::{Duration, Instant};

use anyhow::{Result, bail};

pub(crate) use hands::{Hands, Key};
pub(crate) use picture::{Area, Picture};
pub(crate) use program::Program;
pub(crate) use screen::Screen;
pub(crate) use strokes::{Place, is_tap, laid, laid_out, wacom};

/// How often something is looked at that tells nobody when it changes.
const GLANCE: Duration = Duration::from_millis(30);

/// Waits as a hand does.
#[expect(clippy::disallowed_methods, reason = "a hand draws at a pace, and a screen tells nobody when it has changed")]
pub(crate) fn pause(time: Duration) {
    std::thread::sleep(time);
}

/// Looks again and again until there is something, for no longer than `limit`; `what` is what was waited for.
pub(crate) fn until<T>(limit: Duration, what: &str, mut look: impl FnMut() -> Result<Option<T>>) -> Result<T> {
    let begun = Instant::now();
    loop {
        if let Some(seen) = look()? {
            return Ok(seen);
        }
        if begun.elapsed() > limit {
            bail!("waited {} s in vain for {what}", limit.as_secs());
        }
        pause(GLANCE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waiting_ends_with_what_is_seen_or_with_the_limit() {
        let mut looks = 0;
        let seen = until(Duration::from_secs(60), "three", || {
            looks += 1;
            Ok((looks == 3).then_some(looks))
        });
        assert_eq!(seen.unwrap(), 3);
        let error = until(Duration::ZERO, "nothing", || Ok(None::<()>)).unwrap_err().to_string();
        assert!(error.contains("in vain for nothing"), "{error}");
        assert!(until(Duration::from_secs(60), "trouble", || bail!("trouble") as Result<Option<()>>).is_err());
    }
}
