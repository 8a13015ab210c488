import { useCallback, useEffect, useState } from "react";

export interface Playback {
  timeS: number;
  playing: boolean;
  speed: number;
  seek: (timeS: number) => void;
  toggle: () => void;
  setSpeed: (speed: number) => void;
}

/** A clock from 0 to `durationS` that advances with animation frames while playing and stops at the end. */
export function usePlayback(durationS: number): Playback {
  const [timeS, setTimeS] = useState(0);
  const [playing, setPlaying] = useState(false);
  const [speed, setSpeed] = useState(1);
  const atEnd = timeS >= durationS;

  useEffect(() => {
    if (!playing) return undefined;
    let frame = 0;
    let before = performance.now();
    const step = (now: number) => {
      const elapsedS = ((now - before) / 1000) * speed;
      before = now;
      setTimeS((time) => Math.min(durationS, time + elapsedS));
      frame = requestAnimationFrame(step);
    };
    frame = requestAnimationFrame(step);
    return () => cancelAnimationFrame(frame);
  }, [playing, speed, durationS]);

  const seek = useCallback((to: number) => setTimeS(Math.min(durationS, Math.max(0, to))), [durationS]);
  const toggle = () => {
    if (atEnd) setTimeS(0);
    setPlaying(atEnd || !playing);
  };
  return { timeS, playing: playing && !atEnd, speed, seek, toggle, setSpeed };
}
