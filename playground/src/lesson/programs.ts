// The programs of the lesson, each made of the one before. A test runs them all.

export const SCENARIO = `# Four robots, and four places where things may be hidden.
title = "Hunt"
program = "hunt.starl"
duration = "90s"

[world]
bounds = { low = [-1, -1], high = [5, 5] }
way_point = [
    { name = "A", position = [4, 0.5] },
    { name = "B", position = [4, 4] },
    { name = "C", position = [0.5, 4] },
    { name = "D", position = [2, 2] },
]

[[robots]]
model = "create"
name = "robot"
start = [
    { position = [0, 0] },
    { position = [1, 0] },
    { position = [0, 1] },
    { position = [1, 1] },
]

[network]
delay = "15ms"
`;

const GUARD = " and some place = way_points().first()";

export const FIRST = `/// Robots look for hidden things.
program Hunt

motion = ReachAvoid()

go()
    pre not motion.active and not motion.done${GUARD}
    eff motion.reach_avoid(place, obstacles())
`;

export const WRONG = FIRST.replace(GUARD, "").replace(
  "reach_avoid(place",
  "reach_avoid(way_points().first()",
);

export const EVERYWHERE = `/// Robots look for hidden things. Each goes to the nearest place that is open.
program Hunt

enum Location {choose, drive, done}

motion = ReachAvoid(vicinity = 20cm)

loc: Location = choose
places: List[Point] = way_points()
open: Set[Int] = {i for i in 0..places.size()}
target: Int = 0
found: Set[Int]

/// The open place that is nearest; none if no place is open.
function nearest(places: List[Point], open: Set[Int], from: Point) -> Int?
    let distances = [distance(from, places[i]) for i in open].sorted()
    for i in open
        if distance(from, places[i]) == distances[0]
            return i
    return none

pick()
    pre loc == choose and some i = nearest(places, open, position)
    eff target = i; motion.reach_avoid(places[i], obstacles()); loc = drive

arrive()
    pre loc == drive and motion.done
    eff open.remove(target); found.add(target); loc = choose

again()
    pre loc == drive and not motion.active and not motion.done
    eff loc = choose
`;

export const FINISH = `
finish()
    pre loc == choose and open.size() == 0
    eff motion.stop(); finish(); loc = done
`;

export const ONCE = `
/// No two robots look at the same place.
invariant once: forall r, s: r.id == s.id or r.found.intersection(s.found).size() == 0
`;

export const MESSAGE = `/// A robot has looked at this place.
message Found(place: Int)

`;

export const HANDLER = `
on Found(_, place)
    open.remove(place)
    if loc == drive and target == place then loc = choose
`;

export const FINISHING = EVERYWHERE + FINISH;
export const PROMISING = FINISHING + ONCE;
export const TEAM = (FINISHING + HANDLER + ONCE)
  .replace("motion = ReachAvoid", `${MESSAGE}motion = ReachAvoid`)
  .replace("vicinity = 20cm)\n", "vicinity = 20cm)\nradio = Broadcast()\n")
  .replace(
    "eff open.remove(target); found.add(target); loc = choose",
    "eff\n        open.remove(target)\n        found.add(target)\n        radio.broadcast(Found(target))\n        loc = choose",
  );

export const LOSSY = SCENARIO.replace('delay = "15ms"\n', 'delay = "15ms"\nloss = "30%"\n');
export const FIVE = LOSSY.replace(
  "position = [2, 2] },\n",
  'position = [2, 2] },\n    { name = "E", position = [3, 2.5] },\n',
);
export const CRASH = `${FIVE}
[[fault]]
at = "15s"
kind = "crash"
robots = ["robot2"]
`;

/** A program that a beginner may write from nothing. */
export const OWN = `program Mine

/// A robot is there.
message Arrived()

motion = ReachAvoid()
radio = Broadcast()

go()
    pre not motion.active and not motion.done and some place = way_points().first()
    eff motion.reach_avoid(place, obstacles())

arrive()
    pre motion.done
    eff radio.broadcast(Arrived()); motion.stop(); finish()

on Arrived(_)
    motion.stop()
    finish()
`;
