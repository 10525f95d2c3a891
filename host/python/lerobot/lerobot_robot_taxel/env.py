"""A Gymnasium environment: name what a touch means, from the images of a simulated garment."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
import taxel

#: What a touch may mean, by the number of the action.
MEANINGS = ("none", "kindness", "threat", "attack")
#: Scripts of touches that an episode may play.
SCENES = ("pat", "lash", "stroke", "hold", "press")

Image = npt.NDArray[np.uint16]


class TouchEnv(gymnasium.Env[Image, np.int64]):
    """An episode is a touch; a step is an image, 195 of which are a second.

    The observation is the pressure of every taxel, the action the number of a meaning in ``MEANINGS``. The
    reward is 1 where that is what the board's own map announces, else 0.
    """

    metadata = {"render_modes": ["ansi"], "render_fps": 195}

    def __init__(
        self, scenes: tuple[str, ...] = SCENES, *, garment: str | None = None, render_mode: str | None = None
    ) -> None:
        self.scenes = scenes
        self.render_mode = render_mode
        self._garment = garment
        self._stream: taxel.Board | None = None
        self._frame: taxel.Frame | None = None
        with taxel.open(f"sim:{scenes[0]}", garment=garment, frames=1) as stream:
            taxels = next(event for event in stream if isinstance(event, taxel.Hello)).taxels
        self.observation_space = gymnasium.spaces.Box(0, 65535, (taxels,), np.uint16)
        self.action_space = gymnasium.spaces.Discrete(len(MEANINGS))

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Image, dict[str, Any]]:
        """Begins another touch; ``options={"scene": NAME}`` chooses it."""
        super().reset(seed=seed)
        chosen = self.scenes[int(self.np_random.integers(len(self.scenes)))]
        scene = (options or {}).get("scene", chosen)
        self.close()
        drawn = int(self.np_random.integers(2**31))
        self._stream = taxel.open(f"sim:{scene}", garment=self._garment, seed=drawn)
        image = self._next()
        assert image is not None, "a script has at least one image"
        return image, {"scene": scene}

    def step(self, action: np.int64) -> tuple[Image, float, bool, bool, dict[str, Any]]:
        """Names the meaning of the image seen last, and sees the next one."""
        if self._frame is None or self._frame.image is None:
            raise gymnasium.error.ResetNeeded("reset() begins an episode")
        meant = self._frame.intent.leading
        reward = float(MEANINGS[int(action)] == meant)
        last = self._frame.image
        image = self._next()
        return (last if image is None else image), reward, image is None, False, {"meaning": meant}

    def _next(self) -> Image | None:
        """The next image; none at the end of the script."""
        for event in self._stream or ():
            if isinstance(event, taxel.Frame) and event.image is not None:
                self._frame = event
                return event.image
        self._frame = None
        return None

    def render(self) -> str | None:  # type: ignore[override,unused-ignore]
        """Returns what touches, in a line."""
        if self._frame is None or self.render_mode != "ansi":
            return None
        places = [f"{one['panel_name']}: {one['total']}" for one in self._frame.contacts]
        return ", ".join(places) or "nothing touches"

    def close(self) -> None:
        """Ends the simulation."""
        if self._stream is not None:
            self._stream.close()
        self._stream = self._frame = None
