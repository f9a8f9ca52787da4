//! Work on many items that know nothing of each other, or on two things: on several threads where the feature `parallel` is on, and with the same results in the same order either way.
//!
//! Threads are those of rayon's pool in which the caller runs, or else of its global one.

/// What `f` makes of each item, in the order of the items.
#[cfg(feature = "parallel")]
pub fn map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    use rayon::prelude::*;
    items.par_iter().map(&f).collect()
}

/// What `f` makes of each item, in the order of the items.
#[cfg(not(feature = "parallel"))]
pub fn map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    items.iter().map(f).collect()
}

/// What `f` makes of the first item of which it makes something; it may have been asked about later ones too.
#[cfg(feature = "parallel")]
pub fn find_map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> Option<R> + Sync) -> Option<R> {
    use rayon::prelude::*;
    items.par_iter().find_map_first(&f)
}

/// What `f` makes of the first item of which it makes something; it may have been asked about later ones too.
#[cfg(not(feature = "parallel"))]
pub fn find_map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> Option<R> + Sync) -> Option<R> {
    items.iter().find_map(f)
}

/// What two pieces of work come to, one on each of two threads if there are as many.
#[cfg(feature = "parallel")]
pub fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    rayon::join(a, b)
}

/// What two pieces of work come to, one after the other.
#[cfg(not(feature = "parallel"))]
pub fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    (a(), b())
}

/// Does `work` on one of the threads, so that what it maps meanwhile need not wake them each time.
#[cfg(feature = "parallel")]
pub fn within<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    rayon::scope(|_| work())
}

/// Does `work` on one of the threads, so that what it maps meanwhile need not wake them each time.
#[cfg(not(feature = "parallel"))]
pub fn within<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    work()
}
