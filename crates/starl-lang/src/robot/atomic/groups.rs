//! Which linearizable variables belong together.

use crate::machine::Action;
use crate::robot::instance::Instance;
use alloc::boxed::Box;
use alloc::vec::Vec;

/// The kind of primitive that linearizable variables are.
pub const KIND: &str = "Linearizable";

/// For each action of a program, the group of variables that it must have for itself; none if it needs none.
#[derive(Clone, Debug)]
pub struct Groups(Vec<Option<Box<str>>>);

impl Groups {
    /// Those of actions that use these instances.
    pub fn new(actions: &[Action], instances: &[Instance]) -> Groups {
        let group = |action: &Action| {
            let instance = instances.get(*action.atomic.first()? as usize)?;
            Some((*instance.group).into())
        };
        Groups(actions.iter().map(group).collect())
    }

    /// The number of actions.
    pub fn actions(&self) -> u32 {
        self.0.len() as u32
    }

    /// The group of an action.
    pub fn of_action(&self, action: u32) -> Option<&str> {
        self.0.get(action as usize)?.as_deref()
    }

    /// All groups, in the order of the actions.
    pub fn all(&self) -> impl Iterator<Item = &str> {
        self.0.iter().flatten().map(|group| &**group)
    }
}

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
