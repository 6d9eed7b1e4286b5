"""A torso belt whose limiter is controlled during the crash, as an environment of Gymnasium: `pip install gymnasium`, then

    python gymnasium_belt.py

An action sets the force at which the limiter yields, every millisecond. The cost is that of the chest's acceleration and of the
way of the head beyond 0.5 m. The belt is a force of our own; the lap belt and all else are those of the scenario.
"""

from pathlib import Path

import gymnasium
import numpy as np

import occupant

CART = Path(__file__).resolve().parents[3] / "scenarios" / "cart-lap-torso.toml"
ANCHORAGE = [-0.55, 0.25, -0.75]  # vehicle axes, m
STIFFNESS_N_M = 60e3
STEP_S = 1e-3
MOST_N = 8000.0
MOST_FORWARD_M = 0.5
SEEN = ["upper_torso.acceleration.resultant", "head.level_position.x", "upper_torso.level_position.x", "vehicle.velocity.x"]


class Belt:
    """Webbing from the chest to the car behind it, which the limiter pays out above its force."""

    def __init__(self):
        self.limit_n, self.length_m, self.reach_m, self.force_n = MOST_N, None, 0.0, 0.0

    def __call__(self, t, places, velocities):
        way = np.subtract(places[1], places[0])
        self.reach_m = float(np.linalg.norm(way))
        self.length_m = self.reach_m if self.length_m is None else self.length_m
        self.force_n = min(max(STIFFNESS_N_M * (self.reach_m - self.length_m), 0.0), self.limit_n)
        pull = way / self.reach_m * self.force_n
        return [list(pull), list(-pull)]

    def pay_out(self):
        """Webbing that the limiter has let go stays out."""
        self.length_m = max(self.length_m, self.reach_m - self.limit_n / STIFFNESS_N_M)


class ControlledLimiter(gymnasium.Env):
    metadata = {"render_modes": []}

    def __init__(self, end_s=0.12):
        self.action_space = gymnasium.spaces.Box(0.0, 1.0, (1,), np.float64)
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (len(SEEN) + 1,), np.float64)
        self.end_s = end_s

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        scenario = occupant.Scenario(CART)
        del scenario["belts.torso"]
        scenario["time.end"] = self.end_s
        self.belt = Belt()
        scenario.add_force("torso_belt", [("upper_torso", [0.0, 0.0, 0.1]), ("vehicle", ANCHORAGE)], self.belt)
        self.live = scenario.live()
        self.start_m = self.live["head.level_position.x"]
        return self.seen(), {}

    def seen(self):
        return np.array([self.live[name] for name in SEEN] + [self.belt.force_n])

    def step(self, action):
        self.belt.limit_n = MOST_N * float(np.clip(action, 0.0, 1.0)[0])
        self.live.advance(min(self.live.time + STEP_S, self.live.end))
        now = self.seen()
        self.belt.pay_out()
        chest_g = now[0] / 9.80665
        beyond_m = max(abs(now[1] - self.start_m) - MOST_FORWARD_M, 0.0)
        is_over = self.live.time >= self.live.end - 1e-9
        return now, -STEP_S * (chest_g**2 / 60 + 1e3 * beyond_m), is_over, False, {"chest_g": chest_g}


def play(force_n, end_s=0.12):
    """What a limiter of a constant force gets, and the largest acceleration of the chest, g."""
    environment = ControlledLimiter(end_s)
    environment.reset(seed=1)
    total, most, is_over = 0.0, 0.0, False
    while not is_over:
        _, reward, is_over, _, about = environment.step(np.array([force_n / MOST_N]))
        total, most = total + reward, max(most, about["chest_g"])
    return total, most


if __name__ == "__main__":
    for force_n in (1000, 2000, 4000, 8000):
        total, most = play(force_n)
        print(f"limiter at {force_n} N: reward {total:.2f}, chest {most:.0f} g")
