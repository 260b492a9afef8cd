//! Which linearizable variables belong together.

use alloc::vec::Vec;

/// The groups of linearizable variables: those that some action uses together, directly or through others. Takes the
/// instances that each action uses, and returns for each instance the first of its group.
pub fn join_groups(instances: usize, actions: &[Vec<u32>]) -> Vec<u32> {
    let mut first: Vec<u32> = (0..instances as u32).collect();
    for used in actions {
        let groups = used.iter().filter_map(|&one| first.get(one as usize));
        let groups: Vec<u32> = groups.copied().collect();
        let Some(&least) = groups.iter().min() else {
            continue;
        };
        for group in &mut first {
            if groups.contains(group) {
                *group = least;
            }
        }
    }
    first
}
