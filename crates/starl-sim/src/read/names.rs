//! Resolves a name in the scenario: a robot, a group, or all.

use super::fleet::Draft;
use super::report::{Origin, Report};
use super::section::Section;
use super::suggest;
use super::tree::{Node, Value};
use crate::scenario::{Joins, Moment};
use starl_core::{Duration, RobotId};

/// The names of the fleet. Robots are not listed one by one: a fleet may have a million.
pub(super) struct Names {
    groups: Vec<NamedGroup>,
    total: u32,
    /// The robots that join in the course of the run.
    pub joins: Joins,
    /// Names are those of robots that are there by this moment.
    pub moment: Moment,
}

struct NamedGroup {
    name: String,
    numbered: bool,
    first_number: u64,
    count: u64,
    first_id: u32,
}

impl NamedGroup {
    /// The index in the group of the robot called `name`, whether or not the group is so large.
    fn index(&self, name: &str) -> Option<u64> {
        let number = name.strip_prefix(&self.name)?;
        if !self.numbered {
            return number.is_empty().then_some(0);
        }
        let digits = number.bytes().all(|byte| byte.is_ascii_digit());
        let canonical = digits && (number == "0" || !number.starts_with('0'));
        let number: u64 = number.parse().ok().filter(|_| canonical)?;
        number.checked_sub(self.first_number)
    }

    fn name_of(&self, index: u64) -> String {
        match self.numbered {
            true => format!("{}{}", self.name, self.first_number + index),
            false => self.name.clone(),
        }
    }

    fn ids(&self) -> impl Iterator<Item = RobotId> + use<> {
        (self.first_id..self.first_id + self.count as u32).map(RobotId)
    }
}

impl Names {
    /// The names of these groups; reports names that two robots would share.
    pub fn new(drafts: &[Draft], report: &Report) -> Names {
        let mut names = Names {
            groups: Vec::new(),
            total: 0,
            joins: Joins::default(),
            moment: Moment::default(),
        };
        for draft in drafts {
            let group = NamedGroup {
                name: draft.name.clone(),
                numbered: draft.numbered,
                first_number: draft.first_number.into(),
                count: draft.count as u64,
                first_id: names.total,
            };
            if let Some(name) = names.shared(&group) {
                let field = if draft.path.is_empty() {
                    String::new()
                } else {
                    format!("{}.name", draft.path.trim_end_matches('.'))
                };
                let message = format!("two robots would be called {name}");
                let help = "give the groups different names, or another `first_number`";
                report.problem_with_help(draft.origin, &field, message, help);
            }
            names.total = names.total.saturating_add(draft.count as u32);
            names.groups.push(group);
        }
        names
    }

    /// A name that a robot of this group would share with one of those before.
    fn shared(&self, group: &NamedGroup) -> Option<String> {
        let shared = |other: &NamedGroup| {
            // One name must continue the other's for any to be equal; then try the smaller group.
            let related =
                group.name.starts_with(&other.name) || other.name.starts_with(&group.name);
            let (small, large) = if group.count < other.count {
                (group, other)
            } else {
                (other, group)
            };
            let within = |name: &String| large.index(name).is_some_and(|index| index < large.count);
            if related {
                (0..small.count).map(|at| small.name_of(at)).find(within)
            } else {
                None
            }
        };
        self.groups.iter().find_map(shared)
    }

    /// How many robots there are.
    pub fn count(&self) -> u64 {
        self.total.into()
    }

    /// The robot of this name.
    pub fn find(&self, name: &str) -> Option<RobotId> {
        self.groups.iter().find_map(|group| {
            let index = group.index(name).filter(|&index| index < group.count)?;
            Some(RobotId(group.first_id + index as u32))
        })
    }

    /// Whether this is the name of a robot of a group, even of one beyond the group's count.
    pub fn is_robot(&self, name: &str) -> bool {
        self.groups.iter().any(|group| group.index(name).is_some())
    }

    /// The robot's name.
    pub fn name(&self, robot: RobotId) -> String {
        if let Some(name) = self.joins.name(robot) {
            return name.to_string();
        }
        let of = |group: &&NamedGroup| {
            u64::from(robot.0) < u64::from(group.first_id) + group.count
                && robot.0 >= group.first_id
        };
        match self.groups.iter().find(of) {
            Some(group) => group.name_of(u64::from(robot.0 - group.first_id)),
            None => format!("robot {robot}"),
        }
    }

    /// The robots that a field names; reports unknown names.
    pub fn robots(&self, table: Section<'_>, field: &str) -> Vec<RobotId> {
        match table.node(field) {
            Some(node) => self.of_node(node, &table.path_of(field), table.report),
            None => Vec::new(),
        }
    }

    /// The one robot that a field names.
    pub fn robot(&self, table: Section<'_>, field: &str) -> Option<RobotId> {
        table.text(field)?;
        let node = table.node(field)?;
        self.robot_of(node, &table.path_of(field), table.report)
    }

    /// The one robot that a text names.
    pub fn robot_of(&self, node: &Node, path: &str, report: &Report) -> Option<RobotId> {
        let Value::Text(name) = &node.value else {
            return None;
        };
        let robot = self.present_robot(name);
        if robot.is_none() {
            self.unknown(name, node.origin, path, report);
        }
        robot
    }

    /// How many robots there have been by the moment.
    fn present(&self) -> u32 {
        self.total.saturating_add(self.joins.count(self.moment))
    }

    /// The robot that is called so at the moment, or has the number that is written so: `#3`.
    fn present_robot(&self, name: &str) -> Option<RobotId> {
        let number = || {
            let number: u32 = name.strip_prefix('#')?.parse().ok()?;
            (number < self.present()).then_some(RobotId(number))
        };
        let joined = self.joins.find(name, self.moment);
        joined.or_else(|| self.find(name)).or_else(number)
    }

    /// As [`Names::robots`]; none where the field is left out, which means all.
    pub fn optional_robots(&self, table: Section<'_>, field: &str) -> Option<Vec<RobotId>> {
        table.has(field).then(|| self.robots(table, field))
    }

    /// Several sets of robots that have none in common.
    pub fn parts(&self, table: Section<'_>, field: &str) -> Vec<Vec<RobotId>> {
        let mut parts: Vec<Vec<RobotId>> = Vec::new();
        let mut taken = std::collections::BTreeSet::new();
        for (node, path) in table.list(field) {
            let part = self.of_node(node, &path, table.report);
            if let Some(&robot) = part.iter().find(|robot| taken.contains(*robot)) {
                let message = format!("{} is in two groups", self.name(robot));
                let help = "name each robot once";
                table
                    .report
                    .problem_with_help(node.origin, &path, message, help);
            }
            taken.extend(part.iter().copied());
            parts.push(part);
        }
        parts
    }

    /// The robots that a node names.
    pub fn of_node(&self, node: &Node, path: &str, report: &Report) -> Vec<RobotId> {
        let help = "write a list of names of robots or groups, or \"all\"";
        let mut robots = Vec::new();
        match &node.value {
            Value::Text(text) if text == "all" => robots.extend((0..self.present()).map(RobotId)),
            Value::List(list) if list.is_empty() => {
                report.problem_with_help(node.origin, path, "the list is empty", help);
            }
            Value::List(list) => {
                for (index, node) in list.iter().enumerate() {
                    let path = format!("{path}.{index}");
                    self.add(node, &path, &mut robots, report);
                }
            }
            other => {
                let message = format!("{} is not a list of robots", other.describe());
                report.problem_with_help(node.origin, path, message, help);
            }
        }
        robots.sort_unstable();
        if let Some(twice) = robots.windows(2).find(|pair| pair[0] == pair[1]) {
            let message = format!("{} is named twice", self.name(twice[0]));
            report.problem_with_help(node.origin, path, message, "name each robot once");
        }
        robots.dedup();
        robots
    }

    fn add(&self, node: &Node, path: &str, robots: &mut Vec<RobotId>, report: &Report) {
        let Value::Text(name) = &node.value else {
            let message = format!("{} is not the name of a robot", node.value.describe());
            report.problem_with_help(node.origin, path, message, "write its name in quotes");
            return;
        };
        if let Some(robot) = self.present_robot(name) {
            robots.push(robot);
            return;
        }
        let mut groups = self
            .groups
            .iter()
            .filter(|group| &group.name == name)
            .peekable();
        if groups.peek().is_some() {
            robots.extend(groups.flat_map(NamedGroup::ids));
            return;
        }
        self.unknown(name, node.origin, path, report);
    }

    fn unknown(&self, name: &str, origin: Origin, path: &str, report: &Report) {
        if let Some(at) = self.joins.first(name) {
            let message = format!("{name} is not there yet: it joins at {}", Duration(at.0));
            let help = "name it only in scheduled events with a later time";
            return report.problem_with_help(origin, path, message, help);
        }
        let is_meant = |group: &&NamedGroup| group.name == name && group.count > 0;
        if let Some(group) = self.groups.iter().find(is_meant) {
            let message = format!("{name:?} is the name of a group");
            let help = format!("name one of its robots, such as `{}`", group.name_of(0));
            return report.problem_with_help(origin, path, message, help);
        }
        let mut known: Vec<String> = Vec::new();
        for group in self.groups.iter().filter(|group| group.count > 0) {
            known.extend((0..group.count.min(64)).map(|index| group.name_of(index)));
            known.push(group.name.clone());
        }
        known.dedup();
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let message = format!("there is no robot {name:?}");
        match suggest::help(name, &known, "there are") {
            Some(help) => report.problem_with_help(origin, path, message, help),
            None => report.problem(origin, path, message),
        }
    }
}
