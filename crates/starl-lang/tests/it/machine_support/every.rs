//! A valid program with every instruction in it.

pub const EVERY: &str = r#"
program Every
enum Location init pick wait
type Text
type List[Int]
type List[Float]
type List[Point]
type List[type0]
type Set[Int]
type Set[type0]
type Map[Int, Point]
type Map[type0, type1]
type Area
type List[{name: type0, at: Time, where: Point?}]
type Map[Robot, type1?]
type Map[Int, Int]
constant 1.5
constant -7
text "a, b"
text ", "
variable count Int
variable here Point
variable loc enum0
variable numbers type1
variable notes type10
parameter places type3
parameter limit Duration?
parameter pause Duration in 0 0x3b9aca00
import position query () (Point)
import emit (Int, type0) () labels index
defaults f6
start f5

function scalars function (Int, Int) (Int) registers 20 objects 0
    copy r2 r0
    copy_block r3 r0 #2
    int r5 3
    load_constant r6 c0
    add_int r7 r0 r1
    subtract_int r7 r7 r1
    multiply_int r8 r5 r5
    divide_int r8 r8 r5
    remainder_int r9 r8 r5
    add_constant r9 r9 1
    multiply_constant r9 r9 2
    divide_constant r9 r9 2
    remainder_constant r9 r9 5
    negate_int r9 r9
    absolute_int r9 r9
    minimum_int r10 r9 r5
    maximum_int r10 r9 r5
    subtract_span r11 r9 r5
    multiply_span r11 r11 r5
    scale_span r11 r5 r6
    ratio_span r12 r11 r5
    add_float r12 r12 r6
    subtract_float r12 r12 r6
    multiply_float r12 r12 r6
    divide_float r12 r12 r6
    negate_float r12 r12
    absolute_float r12 r12
    minimum_float r12 r12 r6
    maximum_float r12 r12 r6
    unary r12 r12 sine
    binary r12 r12 r6 power
    float_of_int r13 r5
    int_of_float r14 r13 nearest
    not r15 r5
    and r15 r15 r5
    or r15 r15 r5
    equal r15 r5 r9
    not_equal r15 r5 r9
    less_int r15 r5 r9
    less_equal_int r15 r5 r9
    equal_float r15 r12 r6
    less_float r15 r12 r6
    less_equal_float r15 r12 r6
    return_scalar r15 #0

function points function (Point, Point) (Float) registers 12 objects 0
    copy_point r6 r0
    add_point r6 r6 r3
    subtract_point r6 r6 r3
    negate_point r6 r6
    scale_point r6 r6 r0
    divide_point r6 r6 r0
    equal_point r9 r6 r3
    distance r0 r6 r3
    return_scalar r0 #0

function jumps function (Int, Int) (Int) registers 6 objects 0
    int r2 0
    int r3 0
again:
    add_constant r2 r2 1
    jump_if r0 @one
one:
    jump_unless r0 @two
two:
    jump_if_equal r0 r1 @three
    jump_if_not_equal r0 r1 @three
three:
    jump_if_less r0 r1 @four
    jump_if_less_equal r1 r0 @four
four:
    jump_if_equal_constant r0 4 @five
    jump_if_not_equal_constant r0 4 @five
five:
    jump_if_less_constant r0 4 @six
    jump_unless_less_constant r0 4 @six
six:
    jump_if_less_float r0 r1 @seven
    jump_unless_less_float r0 r1 @seven
seven:
    jump_if_less_equal_float r0 r1 @eight
    jump_unless_less_equal_float r0 r1 @eight
eight:
    require r2
    int r4 3
    loop r3 r4 @again
    jump @out
out:
    copy r4 r2
    copy r5 r3
    call r4 b0 f0
    return_scalar r4 #0

function guard guard () (Bool) registers 1 objects 0
    jump_if_state_not 0 @no v4
    int r0 1
    return #0 #0
no:
    return_false #0

function claim property (Robot) (Bool) registers 6 objects 1
    load_other r1 r0 v0
    load_other_point r2 r0 v1
    load_other_object b0 r0 s0
    size r1 b0
    return_scalar r1 #1

function start procedure () () registers 40 objects 20
    load r0 v0
    add_constant r0 r0 1
    store v0 r0
    call_host r1 b0 h0
    store_point v1 r1
    load_text b0 t0
    call_host r0 b0 h1
    int r0 7
    load_point r1 v1
    load_text b0 t0
    load_text b1 t1
    copy_object b2 b0
    move_object b3 b2
    clear_object b2 type0
    append_text b2 b0
    append_scalar b2 r0 int
    append_point b2 r1
    int r5 1
    append_variant b2 r5 enum0
    append_object b2 b1 type0
    append_quoted b2 b0
    contains_text r6 b2 b1
    split_text b4 b0 b1 type4
    match_text r6 b2 b1 start
    change_text b2 b1 trim
    replace_text b2 b1 b0 b1
    join_texts b2 b4 b0
    number_of_text r6 b2 float
    equal_object r6 b0 b1 type0
    less_object r6 b0 b1 type0
    load_object b5 s0
    list_add b5 r0 b0 type1
    list_add b5 r5 b0 type1
    list_insert b5 r5 r0 b0 type1
    list_get b5 r5 r6 b0
    list_set b5 r5 r6 b0
    list_find r7 b5 r0 b0 type1
    less_element r7 r0 b0 r0 b0 type1
    list_append b5 b5
    list_reverse b5
    list_sort b5 type1
    list_sort_by b5 b5 type1
    int r9 2
    list_slice b5 r5 r9
    sum_int r10 b5
    set_of_list b6 b5 type5
    list_of_set b7 b6 type1
    clear_object b8 type2
    list_add b8 r1 b0 type2
    sum_float r11 b8
    copy_object b9 b6
    set_add b6 r0 b0 type5
    set_remove b9 r0 b0 type5
    set_contains r12 b6 r0 b0 type5
    set_unite b9 b6 type5
    set_intersect b9 b6 type5
    set_subtract b9 b6 type5
    store_object s0 b5
    clear_object b5 type7
    copy r13 r0
    copy_point r14 r1
    map_put b5 r13 b0 type7
    map_get b5 r0 b0 r18 b0 type7
    map_at b5 r0 b0 r14 b0 type7
    map_contains r22 b5 r0 b0 type7
    int r23 0
    map_entry b5 r23 r13 b0
    map_keys b10 b5 type5
    map_values b11 b5 type3
    map_remove b5 r0 b0 type7
    clear_object b5 type12
    map_add b5 r0 b0 r9 type12
    map_add_constant b5 r0 b0 -3 type12
    map_at b5 r0 b0 r9 b0 type12
    add_int r10 r10 r9
    clear_object b12 type8
    load_text b13 t0
    copy_object b14 b7
    map_put b12 r0 b13 type8
    map_get b12 r0 b13 r24 b15 type8
    copy r25 r0
    int r26 1
    copy_point r27 r1
    list_add s1 r25 b13 type10
    int r28 0
    list_get s1 r28 r29 b16
    list_remove_at s1 r28
    float_of_int r30 r5
    circle b17 r1 r30
    area_contains r31 b17 r1
    clear_object b18 type3
    copy_point r32 r1
    list_add b18 r32 b0 type3
    add_point r32 r32 r1
    list_add b18 r32 b0 type3
    float_of_int r32 r0
    list_add b18 r32 b0 type3
    polygon b19 b18
    return #0 #20

function defaults procedure () () registers 1 objects 0
    int r0 0
    store v5 r0
    store v6 r0
    return #0 #0
"#;
