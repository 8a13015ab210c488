import { formatNumber } from "../../lib/format";
import { Icon } from "../../ui/icons";
import type { Playback } from "./usePlayback";

interface Props {
  play: Playback;
  durationS: number;
  /** Times at which the poses of the goals are passed. */
  marks: readonly number[];
}

/** Steps of the scrubber; an integer, so that its last step is exactly the trajectory's end. */
const STEPS = 1000;

/** Play, pause, scrub and speed controls; the ticks mark the goals. */
export function Player({ play, durationS, marks }: Props) {
  const seconds = (time: number) => `${formatNumber(time, 3)} s`;
  return (
    <div className="player">
      <button type="button" className="button primary icon" onClick={play.toggle} aria-label={play.playing ? "Pause" : "Play"}>
        <Icon name={play.playing ? "pause" : "play"} />
      </button>
      <div className="scrub">
        <input
          type="range"
          aria-label="Time in the trajectory"
          aria-valuetext={seconds(play.timeS)}
          min={0}
          max={STEPS}
          step={1}
          value={Math.round((STEPS * play.timeS) / durationS)}
          onChange={(event) => play.seek((durationS * event.currentTarget.valueAsNumber) / STEPS)}
        />
        <div className="ticks" aria-hidden="true">
          {marks.map((mark, index) => (
            <i key={index} style={{ left: `${(100 * mark) / durationS}%` }} />
          ))}
        </div>
      </div>
      <div className="row">
        <span className="small nowrap">
          {seconds(play.timeS)} <span className="muted">of {seconds(durationS)}</span>
        </span>
        <select
          aria-label="Speed"
          style={{ width: 76 }}
          value={play.speed}
          onChange={(event) => play.setSpeed(Number(event.currentTarget.value))}
        >
          {[0.25, 0.5, 1, 2, 4].map((speed) => (
            <option key={speed} value={speed}>
              {speed}×
            </option>
          ))}
        </select>
      </div>
    </div>
  );
}
