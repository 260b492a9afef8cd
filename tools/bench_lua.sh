#!/bin/sh
# Programs in the language and in PUC Lua 5.4 (Debian: apt-get install lua5.4), side by side: best and
# median milliseconds of 21 runs each. `assembly` is what a person wrote for the language's machine.
set -eu
cd "$(dirname "$0")/.."

echo "starl"
cargo bench --quiet -p starl-lang --bench compiled | grep best

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

local function map_int(turns)
    local counts = {}
    for turn = 1, turns do
        for i = 0, 999 do
            local key = i * 7919 % 1000
            counts[key] = (counts[key] or 0) + 1
        end
    end
    return counts[999]
end

local function map_apart(turns)
    local counts = {}
    for i = 0, 999 do
        counts[i * 7919 % 1000] = i
    end
    local s = 0
    for turn = 1, turns do
        for i = 0, 999 do
            local key = i * 7919 % 1000
            s = s + counts[key]
            counts[key] = i
        end
    end
    return s
end

local function map_string(turns)
    local keys = {}
    for i = 0, 999 do
        keys[i] = "key " .. i * 7919 % 1000
    end
    local counts = {}
    for turn = 1, turns do
        for i = 0, 999 do
            local key = keys[i]
            counts[key] = (counts[key] or 0) + 1
        end
    end
    return counts["key 999"]
end

local function strings(turns)
    local found = 0
    for turn = 1, turns do
        local line = ""
        for i = 0, 19 do
            line = line .. "word" .. i .. ","
        end
        for word in line:gmatch("[^,]+") do
            if word == "word7" then
                found = found + 1
            end
        end
    end
    return found
end

local function records(turns)
    local particles = {}
    for i = 0, 99 do
        particles[i] = { x = i, v = 1.0, hits = 0 }
    end
    local hits = 0
    for turn = 1, turns do
        for i = 0, 99 do
            local p = particles[i]
            p.x = p.x + p.v
            if p.x > 50.0 then
                p.v = -1.0
                p.hits = p.hits + 1
            elseif p.x < 0.0 then
                p.v = 1.0
            end
            hits = hits + 1
        end
    end
    return hits
end

local function sort(turns)
    local size = 0
    for turn = 1, turns do
        local x = 42
        local numbers = {}
        for i = 1, 1000 do
            x = (x * 1103515245 + 12345) % 2147483648
            numbers[i] = x
        end
        table.sort(numbers)
        if numbers[1] <= numbers[1000] then
            size = size + #numbers
        end
    end
    return size
end

local function escapes(cr, ci)
    local x, y = 0.0, 0.0
    for i = 1, 50 do
        x, y = x * x - y * y + cr, 2.0 * x * y + ci
        if x * x + y * y > 4.0 then
            return true
        end
    end
    return false
end

local function mandelbrot(size)
    local inside = 0
    for row = 0, size - 1 do
        for column = 0, size - 1 do
            if not escapes(3.0 * column / size - 2.0, 2.0 * row / size - 1.0) then
                inside = inside + 1
            end
        end
    end
    return inside
end

local function measure(name, run, argument, expected)
    local times = {}
    for round = 1, 21 do
        local start = os.clock()
        assert(run(argument) == expected)
        times[round] = (os.clock() - start) * 1e3
    end
    table.sort(times)
    print(string.format("%-40s best %8.3f ms   median %8.3f ms", name, times[1], times[11]))
end

measure("loop of 2,000,000", loop, 2000000, 5999995)
measure("fib 22", fib, 22, 17711)
measure("fib 30", fib, 30, 832040)
measure("list of 1,000, 1,000 times", list, 1000, 499500000)
measure("map by Int of 1,000, 100 times", map_int, 100, 100)
measure("map read and written, 100 times", map_apart, 100, 49950000)
measure("map by String of 1,000, 100 times", map_string, 100, 100)
measure("strings joined and split, 1,000 times", strings, 1000, 1000)
measure("records of 100, 1,000 times", records, 1000, 100000)
measure("sort of 1,000, 50 times", sort, 50, 50000)
measure("mandelbrot of 100 by 100", mandelbrot, 100, 2662)
LUA
