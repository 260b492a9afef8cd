//! The loop that executes instructions.
//!
//! Scalar registers of the running function are a window of 256, so that an operand, a byte, needs no
//! bounds check. Instructions on objects and calls of the host are in [`objects`](super::objects)
//! and beside it: the loop stays small enough for the processor.

use super::scalar;
use crate::machine::error::{Fault, RuntimeError};
use crate::machine::host::Host;
use crate::machine::instruction::Instruction;
use crate::machine::interpreter::maps::found;
use crate::machine::interpreter::view::{Meter, View, object_at, object_at_mut, shift};
use crate::machine::interpreter::workspace::{Frame, OBJECT_WINDOW, Registers, WINDOW, Workspace};
use crate::machine::operand::{ObjectInOut, PointIn, PointOut};
use crate::machine::program::{Known, Program};
use crate::machine::types::{Keys, Parts, bits};
use crate::machine::value::object::{Body, Object};
use crate::machine::value::state::State;
use starl_core::{Point, RobotId};

/// The context of a run of the machine.
pub(in crate::machine) struct Execution<'a> {
    pub program: &'a Program,
    pub state: &'a mut State,
    pub workspace: &'a mut Workspace,
    pub host: &'a mut dyn Host,
    pub meter: Meter,
}

impl Execution<'_> {
    /// Runs a function whose windows begin at these registers until it returns.
    pub fn run(
        &mut self,
        function: u32,
        mut base: usize,
        mut object_base: usize,
    ) -> Result<(), RuntimeError> {
        use Instruction::*;
        let program = self.program;
        let code = &program.bytecode.code[..];
        let entries = &program.entries[..];
        let mut fuel = self.meter.fuel;
        let mut depth = 0usize;
        let mut pc = entries
            .get(function as usize)
            .map_or(usize::MAX, |&entry| entry as usize);

        let fault = 'run: loop {
            // Calls and returns come here to find their windows, and instructions on objects to find
            // theirs again.
            if object_base + OBJECT_WINDOW > self.workspace.objects.len()
                || base + WINDOW > self.workspace.scalars.len()
            {
                if !self.workspace.grow(base, object_base, depth) {
                    // The call is to blame, not what it calls.
                    let caller = depth
                        .checked_sub(1)
                        .and_then(|top| self.workspace.frames.get(top));
                    pc = caller.map_or(pc, |frame| frame.position as usize);
                    break 'run Fault::CallDepth;
                }
                continue 'run;
            }
            let Some(r) = self.workspace.scalars[base..].first_chunk_mut::<WINDOW>() else {
                break 'run Fault::Malformed;
            };

            macro_rules! set {
                ($to:expr, $value:expr) => {
                    r[$to.place()] = $value
                };
            }
            macro_rules! int {
                ($register:expr) => {
                    r[$register.place()] as i64
                };
            }
            macro_rules! float {
                ($register:expr) => {
                    f64::from_bits(r[$register.place()])
                };
            }
            macro_rules! set_int {
                ($to:expr, $value:expr) => {
                    match $value {
                        Some(value) => set!($to, value as u64),
                        None => break 'run Fault::Overflow,
                    }
                };
            }
            macro_rules! set_float {
                ($to:expr, $value:expr) => {
                    set!($to, bits($value))
                };
            }
            macro_rules! set_bool {
                ($to:expr, $value:expr) => {
                    set!($to, u64::from($value))
                };
            }
            macro_rules! jump_if {
                ($condition:expr, $target:expr) => {
                    if $condition {
                        pc = $target.0 as usize;
                    }
                };
            }
            macro_rules! set_or_stop {
                ($to:expr, $value:expr) => {
                    match $value {
                        Ok(value) => set!($to, value),
                        Err(fault) => break 'run fault,
                    }
                };
            }
            macro_rules! spend {
                ($cost:expr) => {
                    match fuel.checked_sub($cost) {
                        Some(rest) => fuel = rest,
                        None => break 'run Fault::OutOfFuel,
                    }
                };
            }
            macro_rules! object_instruction {
                ($instruction:expr) => {{
                    match self.object_instruction($instruction, base, object_base) {
                        Ok(cost) => spend!(cost),
                        Err(fault) => break 'run fault,
                    }
                    continue 'run;
                }};
            }
            macro_rules! leave {
                ($keep:expr, $until:expr) => {
                    if $until.0 != 0 {
                        let end = object_base + usize::from($until.0);
                        let range = object_base + $keep..end;
                        if let Some(objects) = self.workspace.objects.get_mut(range) {
                            objects.fill(Default::default());
                        }
                    }
                    let frame = depth
                        .checked_sub(1)
                        .and_then(|top| self.workspace.frames.get(top));
                    let Some(&frame) = frame else {
                        self.meter.fuel = fuel;
                        return Ok(());
                    };
                    depth -= 1;
                    pc = frame.position as usize;
                    base = frame.base as usize;
                    object_base = frame.object_base as usize;
                    continue 'run;
                };
            }

            loop {
                let Some(&instruction) = code.get(pc) else {
                    break 'run Fault::Malformed;
                };
                pc += 1;
                spend!(1);
                match instruction {
                    Copy { to, from } => set!(to, r[from.place()]),
                    Int { to, value } => set!(to, i64::from(value.0) as u64),
                    Constant { to, constant } => {
                        match program.bytecode.constants.get(constant.0 as usize) {
                            Some(&value) => set!(to, value),
                            None => break 'run Fault::Malformed,
                        }
                    }
                    CopyBlock { to, from, count } => {
                        spend!(u64::from(count.0 / 8));
                        let end = from.place() + usize::from(count.0);
                        if end <= WINDOW && to.place() + usize::from(count.0) <= WINDOW {
                            r.copy_within(from.place()..end, to.place());
                        }
                    }
                    Load { to, variable } => match self.state.scalars.get(variable.0 as usize) {
                        Some(&value) => set!(to, value),
                        None => break 'run Fault::Malformed,
                    },
                    Store { variable, from } => {
                        match self.state.scalars.get_mut(variable.0 as usize) {
                            Some(place) => *place = r[from.place()],
                            None => break 'run Fault::Malformed,
                        }
                    }
                    LoadPoint { to, variable } => match three(&self.state.scalars, variable.0) {
                        Some(point) => set_three(r, to, point),
                        None => break 'run Fault::Malformed,
                    },
                    StorePoint { variable, from } => {
                        let start = variable.0 as usize;
                        match self.state.scalars.get_mut(start..start.wrapping_add(3)) {
                            Some(place) => place.copy_from_slice(&get_three(r, from)),
                            None => break 'run Fault::Malformed,
                        }
                    }
                    LoadOther {
                        to,
                        robot,
                        variable,
                    } => {
                        let robot = RobotId(r[robot.place()] as u32);
                        match scalar::of_other(self.host, robot, variable.0) {
                            Ok(value) => set!(to, value),
                            Err(fault) => break 'run fault,
                        }
                    }
                    LoadOtherPoint {
                        to,
                        robot,
                        variable,
                    } => {
                        let robot = RobotId(r[robot.place()] as u32);
                        match scalar::point_of_other(self.host, robot, variable.0) {
                            Ok(point) => set_three(r, to, point),
                            Err(fault) => break 'run fault,
                        }
                    }

                    AddInt { to, left, right } => set_int!(to, int!(left).checked_add(int!(right))),
                    SubtractInt { to, left, right } => {
                        set_int!(to, int!(left).checked_sub(int!(right)))
                    }
                    MultiplyInt { to, left, right } => {
                        set_int!(to, int!(left).checked_mul(int!(right)))
                    }
                    DivideInt { to, left, right } => {
                        set_or_stop!(to, scalar::divide(int!(left), int!(right)))
                    }
                    RemainderInt { to, left, right } => {
                        set_or_stop!(to, scalar::remainder(int!(left), int!(right)))
                    }
                    AddConstant { to, left, right } => {
                        set_int!(to, int!(left).checked_add(i64::from(right.0)))
                    }
                    MultiplyConstant { to, left, right } => {
                        set_int!(to, int!(left).checked_mul(i64::from(right.0)))
                    }
                    DivideConstant { to, left, right } => {
                        set_or_stop!(to, scalar::divide(int!(left), i64::from(right.0)))
                    }
                    RemainderConstant { to, left, right } => {
                        set_or_stop!(to, scalar::remainder(int!(left), i64::from(right.0)))
                    }
                    NegateInt { to, from } => set_int!(to, int!(from).checked_neg()),
                    AbsoluteInt { to, from } => set_int!(to, int!(from).checked_abs()),
                    MinimumInt { to, left, right } => set!(to, int!(left).min(int!(right)) as u64),
                    MaximumInt { to, left, right } => set!(to, int!(left).max(int!(right)) as u64),

                    SubtractSpan { to, left, right } => {
                        set!(to, int!(left).saturating_sub(int!(right)).max(0) as u64)
                    }
                    MultiplySpan { to, span, times } => {
                        set_int!(to, scalar::multiply_span(int!(span), int!(times)))
                    }
                    ScaleSpan { to, span, factor } => {
                        set_or_stop!(to, scalar::scale_span(int!(span), float!(factor)))
                    }
                    RatioSpan { to, left, right } => {
                        set_or_stop!(to, scalar::ratio_span(int!(left), int!(right)))
                    }

                    AddFloat { to, left, right } => set_float!(to, float!(left) + float!(right)),
                    SubtractFloat { to, left, right } => {
                        set_float!(to, float!(left) - float!(right))
                    }
                    MultiplyFloat { to, left, right } => {
                        set_float!(to, float!(left) * float!(right))
                    }
                    DivideFloat { to, left, right } => set_float!(to, float!(left) / float!(right)),
                    NegateFloat { to, from } => set!(to, r[from.place()] ^ 1 << 63),
                    AbsoluteFloat { to, from } => set!(to, r[from.place()] & !(1 << 63)),
                    MinimumFloat { to, left, right } => {
                        set_float!(to, scalar::minimum(float!(left), float!(right)))
                    }
                    MaximumFloat { to, left, right } => {
                        set_float!(to, scalar::maximum(float!(left), float!(right)))
                    }
                    Unary { to, from, function } => {
                        spend!(7);
                        set_float!(to, scalar::unary(function, float!(from)))
                    }
                    Binary {
                        to,
                        left,
                        right,
                        function,
                    } => {
                        spend!(7);
                        set_float!(to, scalar::binary(function, float!(left), float!(right)))
                    }
                    FloatOfInt { to, from } => set_float!(to, int!(from) as f64),
                    IntOfFloat { to, from, rounding } => {
                        set_or_stop!(to, scalar::int_of_float(float!(from), rounding))
                    }

                    Not { to, from } => set_bool!(to, r[from.place()] == 0),
                    And { to, left, right } => {
                        set_bool!(to, r[left.place()] != 0 && r[right.place()] != 0)
                    }
                    Or { to, left, right } => {
                        set_bool!(to, r[left.place()] != 0 || r[right.place()] != 0)
                    }
                    Equal { to, left, right } => set_bool!(to, r[left.place()] == r[right.place()]),
                    NotEqual { to, left, right } => {
                        set_bool!(to, r[left.place()] != r[right.place()])
                    }
                    LessInt { to, left, right } => set_bool!(to, int!(left) < int!(right)),
                    LessEqualInt { to, left, right } => set_bool!(to, int!(left) <= int!(right)),
                    EqualFloat { to, left, right } => set_bool!(to, float!(left) == float!(right)),
                    LessFloat { to, left, right } => set_bool!(to, float!(left) < float!(right)),
                    LessEqualFloat { to, left, right } => {
                        set_bool!(to, float!(left) <= float!(right))
                    }

                    CopyPoint { to, from } => {
                        let point = get_three(r, from);
                        set_three(r, to, point);
                    }
                    AddPoint { to, left, right } => {
                        let sum = get_point(r, left) + get_point(r, right);
                        set_point(r, to, sum);
                    }
                    SubtractPoint { to, left, right } => {
                        let difference = get_point(r, left) - get_point(r, right);
                        set_point(r, to, difference);
                    }
                    NegatePoint { to, from } => {
                        let point = -get_point(r, from);
                        set_point(r, to, point);
                    }
                    ScalePoint { to, from, factor } => {
                        let product = get_point(r, from) * float!(factor);
                        set_point(r, to, product);
                    }
                    DividePoint { to, from, divisor } => {
                        let quotient = get_point(r, from) / float!(divisor);
                        set_point(r, to, quotient);
                    }
                    Distance { to, left, right } => {
                        set_float!(to, get_point(r, left).distance(get_point(r, right)))
                    }
                    EqualPoint { to, left, right } => {
                        set_bool!(to, get_point(r, left) == get_point(r, right))
                    }

                    Jump { target } => pc = target.0 as usize,
                    JumpIf { condition, target } => jump_if!(r[condition.place()] != 0, target),
                    JumpUnless { condition, target } => jump_if!(r[condition.place()] == 0, target),
                    JumpIfEqual {
                        left,
                        right,
                        target,
                    } => jump_if!(r[left.place()] == r[right.place()], target),
                    JumpIfNotEqual {
                        left,
                        right,
                        target,
                    } => jump_if!(r[left.place()] != r[right.place()], target),
                    JumpIfLess {
                        left,
                        right,
                        target,
                    } => jump_if!(int!(left) < int!(right), target),
                    JumpIfLessEqual {
                        left,
                        right,
                        target,
                    } => jump_if!(int!(left) <= int!(right), target),
                    JumpIfEqualConstant {
                        left,
                        right,
                        target,
                    } => jump_if!(int!(left) == i64::from(right.0), target),
                    JumpIfNotEqualConstant {
                        left,
                        right,
                        target,
                    } => jump_if!(int!(left) != i64::from(right.0), target),
                    JumpIfLessConstant {
                        left,
                        right,
                        target,
                    } => jump_if!(int!(left) < i64::from(right.0), target),
                    JumpUnlessLessConstant {
                        left,
                        right,
                        target,
                    } => jump_if!(int!(left) >= i64::from(right.0), target),
                    JumpIfLessFloat {
                        left,
                        right,
                        target,
                    } => jump_if!(float!(left) < float!(right), target),
                    JumpUnlessLessFloat {
                        left,
                        right,
                        target,
                    } => {
                        let less = float!(left) < float!(right);
                        jump_if!(!less, target)
                    }
                    JumpIfLessEqualFloat {
                        left,
                        right,
                        target,
                    } => jump_if!(float!(left) <= float!(right), target),
                    JumpUnlessLessEqualFloat {
                        left,
                        right,
                        target,
                    } => {
                        let less_equal = float!(left) <= float!(right);
                        jump_if!(!less_equal, target)
                    }
                    JumpIfStateNot {
                        right,
                        target,
                        variable,
                    } => match self.state.scalars.get(usize::from(variable.0)) {
                        Some(&value) => jump_if!(value as i64 != i64::from(right.0), target),
                        None => break 'run Fault::Malformed,
                    },
                    Loop {
                        counter,
                        limit,
                        target,
                    } => match int!(counter).checked_add(1) {
                        Some(next) => {
                            set!(counter, next as u64);
                            jump_if!(next < int!(limit), target)
                        }
                        None => break 'run Fault::Overflow,
                    },
                    Require { present } => {
                        if r[present.place()] == 0 {
                            break 'run Fault::NoneUnwrapped;
                        }
                    }

                    Call {
                        scalars,
                        objects,
                        function,
                    } => {
                        let known = program.known.get(function.0 as usize);
                        if let Some(known) = known.and_then(Option::as_ref) {
                            let places = (base + scalars.place(), object_base + objects.place());
                            match self.give(known, places, base, object_base) {
                                Ok(cost) => spend!(cost),
                                Err(fault) => break 'run fault,
                            }
                            continue 'run;
                        }
                        let Some(&entry) = entries.get(function.0 as usize) else {
                            break 'run Fault::Malformed;
                        };
                        let Some(frame) = self.workspace.frames.get_mut(depth) else {
                            if !self.workspace.grow(base, object_base, depth + 1) {
                                break 'run Fault::CallDepth;
                            }
                            // Again, now that there is room: it is paid for already.
                            pc -= 1;
                            fuel += 1;
                            continue 'run;
                        };
                        *frame = Frame {
                            position: pc as u32,
                            base: base as u32,
                            object_base: object_base as u32,
                        };
                        depth += 1;
                        pc = entry as usize;
                        base += scalars.place();
                        object_base += objects.place();
                        continue 'run;
                    }
                    ReturnScalar { from, until } => {
                        r[0] = r[from.place()];
                        leave!(0, until);
                    }
                    Return { keep, until } => {
                        leave!(usize::from(keep.0), until);
                    }
                    ReturnFalse { until } => {
                        r[0] = 0;
                        leave!(0, until);
                    }
                    // The commonest instructions on objects, in the commonest case.
                    ListGet {
                        list,
                        index,
                        scalars,
                        objects: to,
                    } => {
                        let (objects, state) = (&self.workspace.objects, &self.state.objects);
                        let object = object_at(objects, object_base, state, list.0);
                        let list = object.ok().and_then(Object::list);
                        let index = r[index.place()];
                        match list.and_then(|list| list.scalars_at(index, 0)) {
                            Some(element) if element.len() < 8 => {
                                for (offset, &word) in element.iter().enumerate() {
                                    r[(scalars.place() + offset) % WINDOW] = word;
                                }
                            }
                            _ => {
                                let object = list.and_then(|list| list.object_at(index)).cloned();
                                let place =
                                    (self.workspace.objects).get_mut(object_base + to.place());
                                match share_into(place, object, &mut self.meter) {
                                    Some(cost) => spend!(cost),
                                    None => object_instruction!(instruction),
                                }
                            }
                        }
                    }
                    ListSet {
                        list,
                        index,
                        scalars,
                        ..
                    } => {
                        let (objects, state) =
                            (&mut self.workspace.objects, &mut self.state.objects);
                        let object = object_at_mut(objects, object_base, state, list.0);
                        let element = object
                            .ok()
                            .and_then(Object::own_list_mut)
                            .and_then(|list| list.scalars_at_mut(r[index.place()], 0));
                        match element {
                            Some(element) if element.len() < 8 => {
                                for (offset, word) in element.iter_mut().enumerate() {
                                    *word = r[(scalars.place() + offset) % WINDOW];
                                }
                            }
                            _ => object_instruction!(instruction),
                        }
                    }
                    MapGet { .. }
                    | MapAt { .. }
                    | MapPut { .. }
                    | MapAdd { .. }
                    | MapAddConstant { .. } => {
                        match self.map_instruction(instruction, base, object_base) {
                            Some(()) => spend!(3),
                            None => object_instruction!(instruction),
                        }
                        continue 'run;
                    }
                    Size { to, from } => {
                        let (objects, state) = (&self.workspace.objects, &self.state.objects);
                        let object = object_at(objects, object_base, state, from.0);
                        match object.map(Object::body) {
                            Ok(None) => set!(to, 0),
                            Ok(Some(Body::List(list))) => set!(to, list.len() as u64),
                            _ => object_instruction!(instruction),
                        }
                    }
                    other => object_instruction!(other),
                }
            }
        };
        self.meter.fuel = fuel;
        Err(RuntimeError {
            fault,
            position: pc.wrapping_sub(1) as u32,
        })
    }

    /// Executes an instruction on objects or a call of the host; gives what it costs beyond one.
    #[inline(never)]
    fn object_instruction(
        &mut self,
        instruction: Instruction,
        base: usize,
        object_base: usize,
    ) -> Result<u64, Fault> {
        self.view(base, object_base)?.execute(instruction)
    }

    /// Executes an instruction on an entry of a map that is found without a search and whose value is scalars alone.
    #[inline(never)]
    fn map_instruction(
        &mut self,
        instruction: Instruction,
        base: usize,
        object_base: usize,
    ) -> Option<()> {
        use Instruction::{MapAdd, MapAddConstant, MapAt, MapGet, MapPut};
        let program = self.program;
        let (objects, state) = (&mut self.workspace.objects, &mut self.state.objects);
        let r = self.workspace.scalars.get_mut(base..)?;
        let r: &mut Registers = r.first_chunk_mut()?;
        match instruction {
            MapGet {
                map,
                scalars,
                objects: key,
                to,
                kind,
                ..
            }
            | MapAt {
                map,
                scalars,
                objects: key,
                to,
                kind,
                ..
            } => {
                let map = object_at(objects, object_base, state, map.0).ok()?.map()?;
                let key = (scalars.place(), object_base + key.place());
                let at = found(map, key, program.parts_of(kind)?, r, objects)?;
                let value = map.scalars_at(at)?;
                if value.len() >= 8 {
                    return None;
                }
                let mut to = to.place();
                if let MapGet { .. } = instruction {
                    r[to] = 1;
                    to += 1;
                }
                for (offset, &word) in value.iter().enumerate() {
                    r[(to + offset) % WINDOW] = word;
                }
            }
            MapPut {
                map,
                scalars,
                objects: key,
                kind,
            } => {
                let key = (scalars.place(), object_base + key.place());
                let parts = program.parts_of(kind)?;
                let value = changed(map, key, parts, r, objects, object_base, state)?;
                let start = key.0 + usize::from(parts.keys == Keys::Numbers);
                for (offset, word) in value.iter_mut().enumerate() {
                    *word = r[(start + offset) % WINDOW];
                }
            }
            MapAdd {
                map,
                scalars,
                objects: key,
                kind,
                ..
            }
            | MapAddConstant {
                map,
                scalars,
                objects: key,
                kind,
                ..
            } => {
                let amount = match instruction {
                    MapAdd { amount, .. } => r[amount.place()] as i64,
                    MapAddConstant { amount, .. } => amount.0.into(),
                    _ => return None,
                };
                let key = (scalars.place(), object_base + key.place());
                let parts = program.parts_of(kind)?;
                let value = changed(map, key, parts, r, objects, object_base, state)?;
                let [value] = value else { return None };
                *value = (*value as i64).checked_add(amount)? as u64;
            }
            _ => return None,
        }
        Some(())
    }

    /// Puts what a function is known to give where its results belong; gives what it costs beyond one.
    #[inline(never)]
    fn give(
        &mut self,
        known: &Known,
        (place, object_place): (usize, usize),
        base: usize,
        object_base: usize,
    ) -> Result<u64, Fault> {
        let Workspace {
            scalars, objects, ..
        } = &mut *self.workspace;
        let scalars = scalars.get_mut(place..place + known.scalars.len());
        let objects = objects.get_mut(object_place..object_place + known.objects.len());
        let (Some(scalars), Some(objects)) = (scalars, objects) else {
            return Err(Fault::Malformed);
        };
        scalars.copy_from_slice(&known.scalars);
        objects.clone_from_slice(&known.objects);
        let counting = self.view(base, object_base)?.allocate(known.bytes)?;
        Ok(shift(known.bytes) + counting)
    }

    /// The parts of the machine that instructions on objects work on.
    #[inline(always)]
    fn view(&mut self, base: usize, object_base: usize) -> Result<View<'_>, Fault> {
        let scalars = self.workspace.scalars.get_mut(base..);
        let Some(registers) = scalars.and_then(|s| s.first_chunk_mut::<WINDOW>()) else {
            return Err(Fault::Malformed);
        };
        Ok(View {
            program: self.program,
            registers,
            objects: &mut self.workspace.objects,
            object_base,
            state: &mut self.state.objects,
            host: self.host,
            meter: &mut self.meter,
        })
    }
}

/// The value of a key, to be changed, if it is scalars alone that are found without a search.
#[inline(always)]
fn changed<'a>(
    map: ObjectInOut,
    key: (usize, usize),
    parts: &Parts,
    r: &Registers,
    objects: &'a mut [Object],
    object_base: usize,
    state: &'a mut [Object],
) -> Option<&'a mut [u64]> {
    let read = object_at(objects, object_base, state, map.0).ok()?;
    let at = found(read.map()?, key, parts, r, objects)?;
    let written = object_at_mut(objects, object_base, state, map.0).ok()?;
    written.own_map_mut()?.scalars_at_mut(at)
}

/// Puts a shared object into a register if that is within the memory that is known to be left; gives what it costs.
#[inline(never)]
fn share_into(
    place: Option<&mut Object>,
    object: Option<Object>,
    meter: &mut Meter,
) -> Option<u64> {
    let object = object?;
    let bytes = object.bytes();
    let spare = meter.spare.checked_sub(bytes)?;
    *place? = object;
    meter.spare = spare;
    Some(shift(bytes))
}

fn three(scalars: &[u64], start: u32) -> Option<[u64; 3]> {
    scalars.get(start as usize..)?.first_chunk().copied()
}

fn get_three(r: &Registers, from: PointIn) -> [u64; 3] {
    let [x, y, z] = point_places(from.0);
    [r[x], r[y], r[z]]
}

fn set_three(r: &mut Registers, to: PointOut, point: [u64; 3]) {
    let [x, y, z] = point_places(to.0);
    [r[x], r[y], r[z]] = point;
}

fn get_point(r: &Registers, from: PointIn) -> Point {
    let [x, y, z] = get_three(r, from).map(f64::from_bits);
    Point { x, y, z }
}

fn set_point(r: &mut Registers, to: PointOut, point: Point) {
    set_three(r, to, [point.x, point.y, point.z].map(bits));
}

/// The registers of a point. The verifier sees that they do not go past the last one; going round
/// spares the bounds check.
#[inline(always)]
fn point_places(first: u8) -> [usize; 3] {
    [first, first.wrapping_add(1), first.wrapping_add(2)].map(usize::from)
}
