//! Quantities of robots, as variables in the states that expressions read.
//!
//! Only quantities that some expression reads are filled in.

use super::wording::{Expression, Kind, Wording, places, variable_of};
use crate::world::World;
use starl_core::Point;
use starl_core::event::Hit;
use starl_lang::machine::{Layout, List, Object, State, Type};
use starl_motion::State as Motion;

/// The inputs and outputs of quantities.
#[derive(Debug)]
pub struct Quantities {
    /// The numbers of a robot's row.
    row: usize,
    /// A state for each robot, with the quantities that stay as they are.
    constant: Vec<State>,
    /// The quantities that are filled in, each with its first scalar.
    filled: Vec<(Source, usize)>,
    /// The object that holds the lidar's ranges, if it is read.
    lidar: Option<usize>,
    /// For each column of the row its place, its type and its scalar.
    columns: Vec<(usize, Kind, usize)>,
    kept: Vec<Kept>,
    memory: usize,
}

/// Where a quantity comes from.
#[derive(Clone, Copy, Debug)]
enum Source {
    Position,
    Heading,
    Velocity,
    Touched,
    TouchedRobot,
    Nearest,
    MeanPosition,
    MeanVelocity,
    Steps,
    Column(usize, Kind),
}

/// A quantity that is read as `previous`.
#[derive(Clone, Copy, Debug)]
struct Kept {
    /// The first scalar of the field of `previous`.
    to: usize,
    /// The first scalar of the variable that it is a copy of.
    from: usize,
    words: usize,
}

/// The states of one environment.
pub struct Scratch {
    states: Vec<State>,
    flags: Vec<bool>,
}

impl Scratch {
    pub fn states(&self) -> &[State] {
        &self.states
    }
}

impl Quantities {
    pub fn new(limits: &[(f64, f64)], wording: &Wording, all: &[&Expression]) -> Quantities {
        let mut columns = Vec::new();
        let mut row = 0;
        for column in &wording.columns {
            columns.push((row, column.kind, 0));
            row += column.kind.width();
        }
        let mut quantities = Quantities {
            row,
            constant: vec![State::default(); limits.len()],
            filled: Vec::new(),
            lidar: None,
            columns,
            kept: Vec::new(),
            memory: 0,
        };
        if let Some(first) = all.first() {
            quantities.lay_out(limits, wording, first, &read(all));
        }
        quantities
    }

    fn lay_out(
        &mut self,
        limits: &[(f64, f64)],
        wording: &Wording,
        any: &Expression,
        (scalars, objects): &(Vec<u32>, Vec<u32>),
    ) {
        self.constant = vec![any.program.new_state(); limits.len()];
        let places = places(any.program.bytecode());
        let place_of = |name: &str| {
            let found = places.iter().find(|place| place.0 == name);
            found.map(|&(_, _, scalar, object)| (scalar as usize, object as usize))
        };
        let is_read = |first: usize, words: usize| {
            scalars
                .iter()
                .any(|&scalar| (first..first + words).contains(&(scalar as usize)))
        };
        let mut wanted = Vec::new();
        let previous = places.iter().find(|place| place.0 == "previous");
        if let Some(&(_, Type::Record(fields), start, _)) = previous {
            let mut to = start as usize;
            for (name, ty) in fields {
                let words = Layout::of([ty]).scalars.len();
                if is_read(to, words) {
                    let variable = variable_of(name);
                    let from = place_of(variable).map_or(0, |place| place.0);
                    self.kept.push(Kept { to, from, words });
                    self.memory += words;
                    wanted.push(variable);
                }
                to += words;
            }
        }
        for (column, own) in self.columns.iter_mut().zip(&wording.columns) {
            column.2 = place_of(&own.name).map_or(0, |place| place.0);
        }
        let given = [
            ("position_now", Source::Position),
            ("heading_now", Source::Heading),
            ("velocity_now", Source::Velocity),
            ("touched", Source::Touched),
            ("touched_robot", Source::TouchedRobot),
            ("nearest", Source::Nearest),
            ("mean_position", Source::MeanPosition),
            ("mean_velocity", Source::MeanVelocity),
            ("steps", Source::Steps),
        ];
        let own = wording.columns.iter().zip(&self.columns);
        let own =
            own.map(|(column, &(place, kind, _))| (&*column.name, Source::Column(place, kind)));
        for (name, source) in given.into_iter().chain(own) {
            let Some((scalar, _)) = place_of(name) else {
                continue;
            };
            if is_read(scalar, source.words()) || wanted.contains(&name) {
                self.filled.push((source, scalar));
            }
        }
        let lidar = place_of("lidar").map(|place| place.1);
        self.lidar = lidar.filter(|&object| objects.contains(&(object as u32)));
        for (robot, state) in self.constant.iter_mut().enumerate() {
            let mut set = |name: &str, word: u64| {
                if let Some((scalar, _)) = place_of(name) {
                    state.scalars[scalar] = word;
                }
            };
            set("radius", limits[robot].0.to_bits());
            set("top_speed", limits[robot].1.to_bits());
            for one in &wording.constants {
                let value = one.values.get(robot).copied().unwrap_or(0.0);
                set(&one.name, one.kind.word(value));
            }
        }
    }

    pub fn row(&self) -> usize {
        self.row
    }

    pub fn memory(&self) -> usize {
        self.memory
    }

    pub fn scratch(&self) -> Scratch {
        Scratch {
            states: self.constant.clone(),
            flags: Vec::new(),
        }
    }

    /// Fills in the quantities of an environment.
    pub fn fill(
        &self,
        world: &World,
        rows: &[f64],
        memory: &[u64],
        lidar: &[f64],
        scratch: &mut Scratch,
    ) {
        let Scratch { states, flags } = scratch;
        for &(source, scalar) in &self.filled {
            source.fill(world, rows, self.row, flags, |robot, words: &[u64]| {
                copy(&mut states[robot].scalars[scalar..][..words.len()], words);
            });
        }
        if self.memory > 0 {
            for (state, before) in states.iter_mut().zip(memory.chunks_exact(self.memory)) {
                let mut rest = before;
                for kept in &self.kept {
                    let (words, others) = rest.split_at(kept.words);
                    copy(&mut state.scalars[kept.to..][..kept.words], words);
                    rest = others;
                }
            }
        }
        if let Some(object) = self.lidar {
            let rays = lidar.len() / states.len().max(1);
            for (robot, state) in states.iter_mut().enumerate() {
                let ranges = &lidar[robot * rays..][..rays];
                let ranges = ranges.iter().map(|range| range.to_bits());
                state.objects[object] = Object::from(List::of_scalars(ranges.collect()));
            }
        }
    }

    /// Sets the values of a measure.
    pub fn set_column(&self, place: usize, values: &[[f64; 2]], scratch: &mut Scratch) {
        let column = self.columns.iter().find(|column| column.0 == place);
        let Some(&(_, kind, scalar)) = column else {
            return;
        };
        for (state, value) in scratch.states.iter_mut().zip(values) {
            let words = value.map(|number| kind.word(number));
            let width = kind.width();
            state.scalars[scalar..][..width].copy_from_slice(&words[..width]);
        }
    }

    /// Stores the values for `previous` of the next evaluation.
    pub fn keep(&self, scratch: &Scratch, memory: &mut [u64]) {
        if self.memory == 0 {
            return;
        }
        let rows = memory.chunks_exact_mut(self.memory);
        for (row, state) in rows.zip(&scratch.states) {
            let mut rest = row;
            for kept in &self.kept {
                let (words, others) = rest.split_at_mut(kept.words);
                copy(words, &state.scalars[kept.from..][..kept.words]);
                rest = others;
            }
        }
    }
}

/// Copies one or a few words, without a call.
#[inline]
fn copy(to: &mut [u64], from: &[u64]) {
    match (to, from) {
        ([to], [from]) => *to = *from,
        ([x, y, z], [from_x, from_y, from_z]) => (*x, *y, *z) = (*from_x, *from_y, *from_z),
        (to, from) => to.copy_from_slice(from),
    }
}

impl Source {
    /// The scalars that it takes.
    fn words(self) -> usize {
        match self {
            Source::Position
            | Source::Velocity
            | Source::MeanPosition
            | Source::MeanVelocity
            | Source::Column(_, Kind::Point) => 3,
            _ => 1,
        }
    }

    /// Evaluates it for each robot.
    fn fill(
        self,
        world: &World,
        rows: &[f64],
        row: usize,
        flags: &mut Vec<bool>,
        mut set: impl FnMut(usize, &[u64]),
    ) {
        let robots = &world.states;
        match self {
            Source::Position => each(robots, |one| point(one.pose.position), set),
            Source::Heading => each(robots, |one| [one.pose.yaw.to_bits()], set),
            Source::Velocity => each(robots, |one| point(one.twist.linear), set),
            Source::Touched => {
                for (robot, touched) in world.touched.iter().enumerate() {
                    set(robot, &[u64::from(touched.is_some())]);
                }
            }
            Source::TouchedRobot => {
                flags.clear();
                flags.resize(robots.len(), false);
                for (robot, touched) in world.touched.iter().enumerate() {
                    if let Some(Hit::Robot(other)) = touched {
                        flags[robot] = true;
                        flags[other.index()] = true;
                    }
                }
                for (robot, &flag) in flags.iter().enumerate() {
                    set(robot, &[u64::from(flag)]);
                }
            }
            Source::Nearest => {
                for (robot, state) in robots.iter().enumerate() {
                    let here = state.pose.position;
                    let others = robots
                        .iter()
                        .enumerate()
                        .filter(|(other, _)| *other != robot);
                    let nearest = others.fold(f64::INFINITY, |least, (_, other)| {
                        least.min(here.distance(other.pose.position))
                    });
                    set(robot, &[nearest.to_bits()]);
                }
            }
            Source::MeanPosition => all(robots, |state| state.pose.position, set),
            Source::MeanVelocity => all(robots, |state| state.twist.linear, set),
            Source::Steps => (0..robots.len()).for_each(|robot| set(robot, &[world.actions])),
            Source::Column(place, kind) => {
                for (robot, row) in rows.chunks_exact(row).enumerate() {
                    match kind {
                        Kind::Point => {
                            let (x, y) = (row[place], row[place + 1]);
                            set(robot, &point(Point::planar(x, y)));
                        }
                        kind => set(robot, &[kind.word(row[place])]),
                    }
                }
            }
        }
    }
}

/// Gives each robot its own words.
fn each<const WORDS: usize>(
    robots: &[Motion],
    of: impl Fn(&Motion) -> [u64; WORDS],
    mut set: impl FnMut(usize, &[u64]),
) {
    for (robot, state) in robots.iter().enumerate() {
        set(robot, &of(state));
    }
}

/// Gives all robots the mean of theirs.
fn all(robots: &[Motion], of: impl Fn(&Motion) -> Point, mut set: impl FnMut(usize, &[u64])) {
    let sum = robots.iter().fold(Point::ZERO, |sum, one| sum + of(one));
    let mean = point(sum / robots.len() as f64);
    (0..robots.len()).for_each(|robot| set(robot, &mean));
}

fn point(point: Point) -> [u64; 3] {
    [point.x.to_bits(), point.y.to_bits(), point.z.to_bits()]
}

impl Kind {
    /// The scalar of a number.
    fn word(self, number: f64) -> u64 {
        match self {
            Kind::Bool => u64::from(number != 0.0),
            Kind::Float | Kind::Point => number.to_bits(),
        }
    }
}

/// The scalars and objects that any of the expressions reads.
fn read(all: &[&Expression]) -> (Vec<u32>, Vec<u32>) {
    let (mut scalars, mut objects) = (Vec::new(), Vec::new());
    for expression in all {
        let (own, others) = expression.reads();
        scalars.extend(own);
        objects.extend(others);
    }
    (scalars, objects)
}
