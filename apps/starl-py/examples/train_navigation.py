"""Trains a policy for `starl.env.tasks.Navigation` in a few minutes on one core: proximal policy optimisation (Schulman et
al. 2017) with one policy for all robots. Needs `starl[env]` and `torch`.

`python apps/starl-py/examples/train_navigation.py --out policy.pt` prints, every ten rounds, the part of the robots that end at their
goals and how often a robot touches something in an episode.
"""

from __future__ import annotations

import argparse

import numpy as np
import torch
from gymnasium.vector import AutoresetMode
from torch import Tensor, nn

from starl.env import VectorEnv, tasks


class Policy(nn.Module):
    """The mean of each control by a small network, with one deviation for each; and the value of an observation."""

    def __init__(self, sees: int, does: int) -> None:
        super().__init__()
        self.mean = nn.Sequential(nn.Linear(sees, 64), nn.Tanh(), nn.Linear(64, 64), nn.Tanh(), nn.Linear(64, does))
        self.value = nn.Sequential(nn.Linear(sees, 64), nn.Tanh(), nn.Linear(64, 64), nn.Tanh(), nn.Linear(64, 1))
        self.log_deviation = nn.Parameter(torch.full((does,), -0.5))

    def forward(self, seen: Tensor) -> torch.distributions.Normal:
        return torch.distributions.Normal(self.mean(seen), self.log_deviation.exp())


def collect(env: VectorEnv, policy: Policy, seen: Tensor, steps: int) -> tuple[dict[str, Tensor], Tensor]:
    """Plays some steps. Robots of all environments are rows."""
    keep: dict[str, list[Tensor]] = {name: [] for name in ("seen", "done", "log", "reward", "over", "value")}
    for _ in range(steps):
        with torch.no_grad():
            choice = policy(seen)
            done = choice.sample()
            value = policy.value(seen).squeeze(-1)
        shown, _, terminated, truncated, infos = env.step(done.numpy())
        over = torch.from_numpy(terminated | truncated)[:, None].expand(value.shape)
        reward = torch.from_numpy(infos["robot_rewards"]).float()
        if "final_obs" in infos:
            # The value of an episode that was cut off continues.
            cut = truncated & ~terminated
            for index in np.flatnonzero(cut):
                with torch.no_grad():
                    rest = policy.value(torch.from_numpy(infos["final_obs"][index])).squeeze(-1)
                reward[index] += 0.98 * rest
        row = (seen, done, choice.log_prob(done).sum(-1), reward, over, value)
        for name, entry in zip(keep, row, strict=True):
            keep[name].append(entry)
        seen = torch.from_numpy(shown)
    return {name: torch.stack(rows) for name, rows in keep.items()}, seen


def advantages(played: dict[str, Tensor], last: Tensor, discount: float = 0.98, decay: float = 0.95) -> Tensor:
    """Generalised advantage estimates (Schulman et al. 2016)."""
    result, running, following = torch.zeros_like(played["reward"]), torch.zeros_like(last), last
    for step in reversed(range(len(result))):
        goes_on = (~played["over"][step]).float()
        error = played["reward"][step] + discount * following * goes_on - played["value"][step]
        running = error + discount * decay * goes_on * running
        result[step], following = running, played["value"][step]
    return result


def learn(policy: Policy, optimiser: torch.optim.Optimizer, played: dict[str, Tensor], gains: Tensor) -> None:
    flat = {name: rows.flatten(0, 2) for name, rows in played.items()}
    gains, goals = gains.flatten(), (gains + played["value"]).flatten()
    gains = (gains - gains.mean()) / (gains.std() + 1e-8)
    for _ in range(4):
        for part in torch.split(torch.randperm(len(gains)), 4096):
            choice = policy(flat["seen"][part])
            ratio = (choice.log_prob(flat["done"][part]).sum(-1) - flat["log"][part]).exp()
            gain = torch.minimum(ratio * gains[part], ratio.clamp(0.8, 1.2) * gains[part]).mean()
            error = (policy.value(flat["seen"][part]).squeeze(-1) - goals[part]).square().mean()
            optimiser.zero_grad()
            (0.5 * error - gain).backward()
            nn.utils.clip_grad_norm_(policy.parameters(), 0.5)
            optimiser.step()


def judge(policy: Policy, robots: int, seed: int = 10_000) -> tuple[float, float]:
    """The part of robots at their goals at the end of 256 fresh episodes, and touches of a robot in an episode."""
    env = VectorEnv(tasks.Navigation(robots), 256, autoreset_mode=AutoresetMode.SAME_STEP)
    seen, _ = env.reset(seed=seed)
    is_open, arrived, touches = np.ones(256, np.bool_), np.zeros(256), 0
    while is_open.any():
        with torch.no_grad():
            action = policy.mean(torch.from_numpy(seen)).numpy()
        seen, _, terminated, truncated, infos = env.step(action)
        over = (terminated | truncated) & is_open
        touches += int((env.world.contacts[is_open & ~over] >= 0).sum())
        if over.any():
            arrived[over] = infos["final_info"]["arrived"][over]
        is_open &= ~over
    return float(arrived.mean()), touches / (256 * robots)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=4)
    parser.add_argument("--environments", type=int, default=128)
    parser.add_argument("--rounds", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", default="policy.pt")
    arguments = parser.parse_args()
    torch.manual_seed(arguments.seed)
    torch.set_num_threads(1)
    task = tasks.Navigation(arguments.robots)
    env = VectorEnv(task, arguments.environments, autoreset_mode=AutoresetMode.SAME_STEP)
    first, _ = env.reset(seed=arguments.seed)
    seen = torch.from_numpy(first)
    policy = Policy(seen.shape[-1], env.world.action_numbers)
    optimiser = torch.optim.Adam(policy.parameters(), lr=1e-3)
    for round in range(arguments.rounds + 1):
        if round % 10 == 0:
            arrived, touches = judge(policy, arguments.robots)
            print(f"round {round}: {arrived:.0%} of the robots arrive; {touches:.1f} touches", flush=True)
        played, seen = collect(env, policy, seen, 64)
        with torch.no_grad():
            last = policy.value(seen).squeeze(-1)
        learn(policy, optimiser, played, advantages(played, last))
    torch.save(policy.state_dict(), arguments.out)
    print(f"the policy is in {arguments.out}")


if __name__ == "__main__":
    main()
