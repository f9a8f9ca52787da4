//! The desktop's program.
fn main() {}
