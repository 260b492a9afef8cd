//! A robot and its world with random answers: each query gets a value of the right type, and the same query in the same
//! moment gets the same value.
//!
//! Shared variables hold the values written. Calls with an effect are recorded in order.

use starl_core::{Area, Duration, Point, Random, RobotId, Time};
use starl_lang::machine::{
    Bytecode, Host, HostCall, Import, Object, ObjectType, Program, State, Type, Value,
};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The robot that runs the program.
pub const ME: RobotId = RobotId(1);

/// The world's answers and the record of calls.
#[derive(Clone, Default)]
pub struct World {
    /// Answers may differ from one moment to the next.
    pub moment: u64,
    /// How many effects there were.
    pub effects: u64,
    /// The recorded calls.
    pub log: Vec<String>,
    shared: BTreeMap<i64, Value>,
}

impl World {
    /// The answer to a call with these arguments; none if it gives nothing.
    pub fn answer(
        &mut self,
        bytecode: &Bytecode,
        import: &Import,
        arguments: &[Value],
    ) -> Result<Option<Value>, String> {
        let words: Vec<String> = arguments.iter().map(|value| format!("{value}")).collect();
        let call = format!("{}({})", import.name, words.join(", "));
        let mut moment = self.moment;
        if !import.query {
            self.effects += 1;
            moment = self.effects;
            self.log.push(call.clone());
        }
        if let Some(answer) = self.of_shared(&import.name, arguments) {
            return Ok(answer);
        }
        match (&import.name[..], arguments) {
            ("me", _) => return Ok(Some(Value::Robot(ME))),
            ("random_int", [Value::Int(low), Value::Int(high)]) if low >= high => {
                return Err("there is no number between".into());
            }
            ("random_int", [Value::Int(low), Value::Int(high)]) => {
                let width = (*high as i128 - *low as i128) as u128;
                let offset = u128::from(hash(&call, moment)) % width;
                return Ok(Some(Value::Int((*low as i128 + offset as i128) as i64)));
            }
            _ => {}
        }
        let mut random = Random::keyed(hash(&call, moment), &[]);
        Ok(import
            .results
            .first()
            .map(|kind| value(bytecode, kind, &mut random, 3)))
    }

    fn of_shared(&mut self, name: &str, arguments: &[Value]) -> Option<Option<Value>> {
        let (kind, member) = name.split_once('.')?;
        let (Some(Value::Int(instance)), rest) =
            arguments.split_first().map(|(a, b)| (Some(a), b))?
        else {
            return None;
        };
        let held = self.shared.get(instance).cloned();
        let maybe =
            |held: Option<Value>| held.map_or(Value::None, |value| Value::Some(Box::new(value)));
        Some(match (kind, member, rest) {
            ("MultiWriter" | "Linearizable" | "shared", "read", _) => Some(maybe(held)),
            ("SingleWriter" | "shared", "element", [.., Value::Robot(robot)]) => {
                Some(maybe(held.filter(|_| *robot == ME)))
            }
            ("SingleWriter" | "shared", "all", _) => {
                let entries = held.map(|value| (Value::Robot(ME), value));
                Some(Value::Map(entries.into_iter().collect()))
            }
            ("MultiWriter" | "SingleWriter" | "Linearizable", "write" | "initialize", [value]) => {
                self.shared.insert(*instance, value.clone());
                None
            }
            _ => return None,
        })
    }
}

/// Some number that depends on the text and the moment.
fn hash(text: &str, moment: u64) -> u64 {
    let start = 0xcbf2_9ce4_8422_2325_u64 ^ moment.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    text.bytes().fold(start, step)
}

/// Some value of a type.
pub fn value(bytecode: &Bytecode, kind: &Type, random: &mut Random, depth: u32) -> Value {
    let float = |random: &mut Random| f64::from(random.below(33)) / 4.0 - 3.0;
    match kind {
        Type::Bool => Value::Bool(random.chance(0.5)),
        Type::Int => Value::Int(i64::from(random.below(12)) - 3),
        Type::Float => Value::Float(float(random)),
        Type::Time => Value::Time(Time(u64::from(random.below(50)) * 200_000_000)),
        Type::Duration => Value::Duration(Duration(u64::from(random.below(50)) * 100_000_000)),
        Type::Robot => Value::Robot(RobotId(random.below(3))),
        Type::Enum(number) => {
            let of = &bytecode.enums[usize::from(*number)];
            Value::Variant(of.variants[random.below(of.variants.len() as u32) as usize].clone())
        }
        Type::Point => Value::Point(Point::new(float(random), float(random), float(random))),
        Type::Optional(_) if random.chance(0.3) => Value::None,
        Type::Optional(kind) => Value::Some(Box::new(value(bytecode, kind, random, depth))),
        Type::Record(fields) => {
            let fields = fields.iter();
            let of = |(name, kind): &(String, Type)| {
                (name.clone(), value(bytecode, kind, random, depth))
            };
            Value::Record(fields.map(of).collect())
        }
        Type::Object(number) => object(
            bytecode,
            &bytecode.types[usize::from(*number)],
            random,
            depth,
        ),
    }
}

fn object(bytecode: &Bytecode, kind: &ObjectType, random: &mut Random, depth: u32) -> Value {
    let count = if depth == 0 { 0 } else { random.below(4) };
    let values = |kind: &Type, random: &mut Random| -> Vec<Value> {
        (0..count)
            .map(|_| value(bytecode, kind, random, depth - 1))
            .collect()
    };
    match kind {
        ObjectType::Text => {
            let texts = ["", "a", "b c", "a,b", "\u{e9}x"];
            Value::Text(texts[random.below(5) as usize].into())
        }
        ObjectType::Area => Value::Area(Some(Area::Circle {
            center: Point::new(f64::from(random.below(4)), 1.0, 0.0),
            radius: f64::from(random.below(4)),
        })),
        ObjectType::Obstacles => Value::Obstacles([].into()),
        ObjectType::List(kind) => Value::List(values(kind, random)),
        ObjectType::Set(kind) => Value::Set(distinct(values(kind, random), |value| value)),
        ObjectType::Map(key, of) => {
            let keys = values(key, random);
            let entries = keys
                .into_iter()
                .map(|key| (key, value(bytecode, of, random, depth - 1)));
            Value::Map(distinct(entries.collect(), |(key, _)| key))
        }
    }
}

/// Those that do not look like one before.
fn distinct<T>(all: Vec<T>, key: impl Fn(&T) -> &Value) -> Vec<T> {
    let mut seen = std::collections::BTreeSet::new();
    all.into_iter()
        .filter(|one| seen.insert(key(one).to_string()))
        .collect()
}

/// The world as the host of a program.
pub struct TestHost<'a> {
    pub program: &'a Program,
    pub world: World,
    /// The states of the other robots, by number.
    pub others: Vec<State>,
}

impl Host for TestHost<'_> {
    fn call(&mut self, _: u32, call: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>> {
        let (program, import) = (self.program, call.import);
        let arguments = Value::read_all(program, &import.arguments, call.scalars, call.objects)
            .expect("the machine gives values of the types that the import has");
        let answer = self.world.answer(program.bytecode(), import, &arguments)?;
        if let (Some(answer), Some(kind)) = (answer, import.results.first()) {
            let (mut scalars, mut objects) = (Vec::new(), Vec::<Object>::new());
            assert!(
                answer.write(program, kind, &mut scalars, &mut objects),
                "{answer} {kind:?}"
            );
            call.scalars[..scalars.len()].copy_from_slice(&scalars);
            call.objects[..objects.len()].clone_from_slice(&objects);
        }
        Ok(0)
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        self.others.get(robot.0 as usize)
    }
}
