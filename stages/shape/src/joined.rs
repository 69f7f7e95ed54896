//! Sets of whole numbers that are joined one by one (union–find): trees of which each number has its parent, a root itself.

/// The root of a number's set; ways to it are halved.
pub fn root(parents: &mut [u32], mut of: u32) -> u32 {
    while parents[of as usize] != of {
        parents[of as usize] = parents[parents[of as usize] as usize];
        of = parents[of as usize];
    }
    of
}

/// Joins the sets of two numbers: the lower root stays, in whatever order sets are joined.
pub fn join(parents: &mut [u32], a: u32, b: u32) {
    let [a, b] = [a, b].map(|of| root(parents, of));
    parents[a.max(b) as usize] = a.min(b);
}
