// Drag-and-drop upload. Each file is its own demonstration unless they were recorded together.

import { useId, useRef, useState, type DragEvent } from "react";
import { Link } from "react-router";
import { useUpload } from "../../api/mutations";
import type { Demonstration } from "../../api/types";
import { formatBytes } from "../../lib/format";
import { Notice, Problem } from "../../ui/feedback";

interface Outcome {
  name: string;
  bytes: number;
  demonstration?: Demonstration;
  error?: Error;
}

export function UploadCard() {
  const ids = useId();
  const upload = useUpload();
  const picker = useRef<HTMLInputElement>(null);
  const [over, setOver] = useState(false);
  const [together, setTogether] = useState(false);
  const [alignStart, setAlignStart] = useState(false);
  const [units, setUnits] = useState("");
  const [outcomes, setOutcomes] = useState<Outcome[]>([]);

  const send = async (list: FileList | null) => {
    const files = [...(list ?? [])];
    const bundles = together && files.length > 0 ? [files] : files.map((file) => [file]);
    setOutcomes([]);
    for (const bundle of bundles) {
      const outcome: Outcome = { name: stem(bundle[0]?.name ?? ""), bytes: bundle.reduce((sum, file) => sum + file.size, 0) };
      try {
        outcome.demonstration = await upload.mutateAsync({ name: outcome.name, files: bundle, units, alignStart });
      } catch (error) {
        outcome.error = error instanceof Error ? error : new Error(String(error));
      }
      setOutcomes((before) => [...before, outcome]);
    }
    if (picker.current !== null) picker.current.value = "";
  };

  const drag = (inside: boolean) => (event: DragEvent) => {
    event.preventDefault();
    setOver(inside);
  };
  const drop = (event: DragEvent) => {
    event.preventDefault();
    setOver(false);
    void send(event.dataTransfer.files);
  };

  return (
    <div className="stack">
      <section
        className={over ? "drop over" : "drop"}
        aria-label="Upload demonstrations"
        onDragOver={drag(true)}
        onDragLeave={drag(false)}
        onDrop={drop}
      >
        <h2>Drop recordings here</h2>
        <p className="muted small">CSV with a header, YARP logs, reduced files, or canonical JSON</p>
        <input
          ref={picker}
          id={`${ids}files`}
          className="hidden-visually"
          tabIndex={-1}
          type="file"
          multiple
          aria-label="Files to upload"
          onChange={(event) => void send(event.currentTarget.files)}
        />
        <button type="button" className="button" disabled={upload.isPending} onClick={() => picker.current?.click()}>
          {upload.isPending ? "Uploading…" : "Choose files"}
        </button>
        <details style={{ textAlign: "left", width: "min(100%, 560px)" }}>
          <summary>Import options</summary>
          <div className="stack">
            <label className="check">
              <input type="checkbox" checked={together} onChange={(event) => setTogether(event.currentTarget.checked)} />
              <span>The files were recorded together: one demonstration, one stream per file</span>
            </label>
            <label className="check">
              <input type="checkbox" checked={alignStart} onChange={(event) => setAlignStart(event.currentTarget.checked)} />
              <span>The streams&apos; clocks differ: align them by their start</span>
            </label>
            <div className="field">
              <label htmlFor={`${ids}units`}>Units</label>
              <input id={`${ids}units`} value={units} placeholder="x=m, force=N" onChange={(event) => setUnits(event.currentTarget.value)} />
              <span className="hint">Needed only if the header does not state them.</span>
            </div>
          </div>
        </details>
      </section>
      {outcomes.map((outcome) => (
        <OutcomeNotice key={outcome.name} outcome={outcome} />
      ))}
    </div>
  );
}

function OutcomeNotice({ outcome: { name, bytes, demonstration, error } }: { outcome: Outcome }) {
  if (error !== undefined) return <Problem error={error} title={`${name} was rejected`} />;
  if (demonstration === undefined) return null;
  const { findings, id } = demonstration;
  return (
    <Notice tone={findings > 0 ? "warn" : "good"} title={`${name} was imported (${formatBytes(bytes)})`}>
      <p>
        {findings === 0 ? "No findings. " : `${findings} ${findings === 1 ? "finding" : "findings"}. `}
        <Link to={`/demonstrations/${id}`}>{findings > 0 ? "See findings and remedies" : "Open"}</Link>
      </p>
    </Notice>
  );
}

function stem(fileName: string): string {
  return fileName.replace(/\.\w+$/, "");
}
