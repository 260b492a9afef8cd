//! Race in the machine's text form, with the primitives of the native program.

/// See `examples/race`.
pub const RACE: &str = r#"
program Race
enum Location init pick wait
enum Planner auto rrt rrt_connect rrt_star
enum Order unordered fifo causal total
type List[Point]
type Text
type Obstacles
text "arrived"
constant 0.075
parameter vicinity Float
variable loc enum0
variable currentIndex Int
variable target type0
import way_points query () (type0)
import emit (type1, Int) () labels index
import ReachAvoid.bind (Int, Float?, Float?, Float?, Duration?, Int?, enum1?, Int?, Float?) ()
import ReachAvoid.reach_avoid (Int, Point, type2) ()
import ReachAvoid.active query (Int) (Bool)
import ReachAvoid.done query (Int) (Bool)
import Broadcast.bind (Int, type1?, enum2?) ()
import Broadcast.broadcast (Int, {index: Int}) (Int) labels Reached
import obstacles query () (type2)
import finish () ()
import ReachAvoid.stop (Int) ()
primitive motion ReachAvoid
primitive radio Broadcast
defaults f0
start f1
action initialize f2 f3
action pick f4 f5
action wait f6 f7
action finish f8 f9
handler Reached f10
property in_order 1 always f11

function defaults procedure () () registers 1 objects 0
    load_constant r0 c0
    store v0 r0
    return #0 #0

function start procedure () () registers 18 objects 1
    int r0 0
    int r1 1
    load r2 v0
    int r3 0
    int r4 0
    int r5 0
    int r6 0
    int r7 0
    int r8 0
    int r9 0
    int r10 0
    int r11 0
    int r12 0
    int r13 0
    int r14 0
    int r15 0
    int r16 0
    call_host r0 b0 h2
    int r0 1
    int r1 0
    int r2 0
    int r3 0
    clear_object b0 type1
    call_host r0 b0 h6
    return #0 #1

function initialize.pre guard () (Bool) registers 1 objects 0
    jump_if_state_not 0 @no v1
    int r0 1
    return #0 #0
no:
    return_false #0

function initialize.eff procedure () () registers 1 objects 1
    call_host r0 b0 h0
    move_object s0 b0
    int r0 0
    store v2 r0
    int r0 1
    store v1 r0
    return #0 #1

function pick.pre guard () (Bool) registers 3 objects 0
    load r1 v2
    size r2 s0
    jump_if_less r1 r2 @inside
    jump @no
inside:
    jump_if_state_not 1 @waiting v1
    jump @yes
waiting:
    jump_if_state_not 2 @no v1
    int r0 0
    call_host r0 b0 h4
    jump_if r0 @no
    int r0 0
    call_host r0 b0 h5
    jump_if r0 @no
yes:
    int r0 1
    return #0 #0
no:
    return_false #0

function pick.eff procedure () () registers 8 objects 1
    call_host r0 b0 h8
    load r7 v2
    list_get s0 r7 r1 b1
    int r0 0
    call_host r0 b0 h3
    int r0 2
    store v1 r0
    return #0 #1

function wait.pre guard () (Bool) registers 3 objects 0
    jump_if_state_not 2 @no v1
    int r0 0
    call_host r0 b0 h5
    jump_unless r0 @no
    load r1 v2
    size r2 s0
    jump_if_less r1 r2 @yes
no:
    return_false #0
yes:
    int r0 1
    return #0 #0

function wait.eff procedure () () registers 4 objects 1
    load r0 v2
    load_text b0 t0
    call_host r0 b0 h1
    int r0 1
    load r1 v2
    call_host r0 b0 h7
    load r0 v2
    add_constant r0 r0 1
    store v2 r0
    int r0 1
    store v1 r0
    return #0 #1

function finish.pre guard () (Bool) registers 3 objects 0
    jump_if_state_not 1 @no v1
    load r1 v2
    size r2 s0
    jump_if_less r1 r2 @no
    int r0 1
    return #0 #0
no:
    return_false #0

function finish.eff procedure () () registers 1 objects 0
    int r0 0
    call_host r0 b0 h10
    int r0 2
    store v1 r0
    call_host r0 b0 h9
    return #0 #0

function Reached procedure (Robot, Int) () registers 3 objects 0
    load r2 v2
    jump_if_less r1 r2 @end
    add_constant r1 r1 1
    store v2 r1
    int r1 1
    store v1 r1
end:
    return #0 #0

function in_order property (Robot) (Bool) registers 3 objects 1
    load_other_object b0 r0 s0
    size r1 b0
    load_other r2 r0 v2
    less_equal_int r0 r2 r1
    return_scalar r0 #1
"#;
