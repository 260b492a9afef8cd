#!/bin/sh
# Programs in the language and in PUC Lua 5.4 (Debian: apt-get install lua5.4), side by side: best and
# median milliseconds of 21 runs each. `assembly` is what a person wrote for the language's machine.
set -eu
cd "$(dirname "$0")/.."

echo "starl"
cargo bench --quiet -p starl-lang --bench compiled | grep -E 'loop of|fib|list of'

echo "assembly"
cargo bench --quiet -p starl-lang --no-default-features --bench machine | grep -E 'loop of|fib|list of'

echo "$(lua5.4 -v | cut -d' ' -f1-2)"
lua5.4 - <<'LUA'
local function loop(turns)
    local s = 0
    for i = 0, turns - 1 do
        s = s + i % 7
    end
    return s
end

local function fib(n)
    if n < 2 then
        return n
    end
    return fib(n - 1) + fib(n - 2)
end

local function list(turns)
    local numbers = {}
    for i = 0, 999 do
        numbers[i] = i
    end
    local s = 0
    for turn = 1, turns do
        for i = 0, 999 do
            local number = numbers[i]
            s = s + number
            numbers[i] = number
        end
    end
    return s
end

local function measure(name, run, argument, expected)
    local times = {}
    for round = 1, 21 do
        local start = os.clock()
        assert(run(argument) == expected)
        times[round] = (os.clock() - start) * 1e3
    end
    table.sort(times)
    print(string.format("%-28s best %8.3f ms   median %8.3f ms", name, times[1], times[11]))
end

measure("loop of 2,000,000", loop, 2000000, 5999995)
measure("fib 22", fib, 22, 17711)
measure("fib 30", fib, 30, 832040)
measure("list of 1,000, 1,000 times", list, 1000, 499500000)
LUA
