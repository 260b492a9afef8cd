#!/usr/bin/env bash
# Runs Race on two hosts that this script makes itself: two network namespaces with a wire between them, which is cut for
# five seconds. The fleet file makes the network lose and delay packets. Needs root and iproute2.
#
#     tools/namespaces.sh STARL FOLDER
set -euo pipefail
starl=$(realpath "$1")
folder=$2
here=$(cd "$(dirname "$0")/.." && pwd)
one=starl-one-$$
two=starl-two-$$

rm -rf "$folder"
mkdir -p "$folder"
cp "$here"/examples/race/race.toml "$here"/examples/race/race.starl "$folder"
cp -r "$here"/examples/race/worlds "$folder"
cat > "$folder/fleet.toml" <<'FLEET'
scenario = "race.toml"

[link.rehearse]
loss = 0.2
delay = "40ms"
jitter = "15ms"

[robots.iRobot0]
address = "10.77.0.1:7400"
[robots.iRobot1]
address = "10.77.0.2:7400"
[robots.quadcopter0]
address = "10.77.0.1:7401"
[robots.quadcopter1]
address = "10.77.0.2:7401"
FLEET

end() {
    kill $(jobs -p) 2> /dev/null || true
    wait || true
    ip netns del "$one" 2> /dev/null || true
    ip netns del "$two" 2> /dev/null || true
}
trap end EXIT

ip netns add "$one"
ip netns add "$two"
ip -n "$one" link add wire type veth peer name wire netns "$two"
for place in "$one 1" "$two 2"; do
    read -r name number <<< "$place"
    ip -n "$name" addr add "10.77.0.$number/24" dev wire
    ip -n "$name" link set wire up
    ip -n "$name" link set lo up
done

cd "$folder"
"$starl" fleet key fleet.toml > key.log
on() {
    ip netns exec "$1" "$starl" robot --id "$2" --fleet fleet.toml --folder run &
}
on "$one" iRobot0
on "$one" quadcopter0
on "$two" iRobot1
on "$two" quadcopter1
sleep 4
ip netns exec "$one" "$starl" fleet status fleet.toml || true
ip -n "$one" link set wire down
sleep 5
ip -n "$one" link set wire up
for _ in $(seq 60); do
    sleep 1
    finished=$(ip netns exec "$one" "$starl" fleet status fleet.toml --json | grep -c '"finished"' || true)
    if [ "$finished" = 4 ]; then break; fi
done
ip netns exec "$one" "$starl" fleet status fleet.toml || true
ip netns exec "$one" "$starl" fleet stop fleet.toml
wait
"$starl" fleet merge fleet.toml --folder run --out run.mcap
"$starl" verify run.mcap
[ "$finished" = 4 ]
