import { useId, useState, type SyntheticEvent } from "react";
import { Link } from "react-router";
import { useCreateRobot } from "../../api/mutations";
import { Card } from "../../ui/basics";
import { Notice, Problem } from "../../ui/feedback";

/** Adds a robot from its URDF; everything except the file is optional. */
export function NewRobot() {
  const create = useCreateRobot();
  const ids = useId();
  const [name, setName] = useState("");
  const [tipLink, setTipLink] = useState("");
  const [file, setFile] = useState<File | null>(null);

  const submit = async (event: SyntheticEvent) => {
    event.preventDefault();
    if (file === null) return;
    create.mutate({ name: name.trim() === "" ? file.name.replace(/\.\w+$/, "") : name.trim(), urdf: await file.text(), tipLink });
  };
  return (
    <Card title="Add a robot">
      <form className="stack" onSubmit={(event) => void submit(event)}>
        <div className="fields">
          <div className="field">
            <label htmlFor={`${ids}file`}>URDF</label>
            <input
              id={`${ids}file`}
              type="file"
              accept=".urdf,.xml"
              required
              onChange={(event) => setFile(event.currentTarget.files?.[0] ?? null)}
            />
            <span className="hint">Meshes are not needed.</span>
          </div>
          <div className="field">
            <label htmlFor={`${ids}name`}>Name</label>
            <input id={`${ids}name`} value={name} onChange={(event) => setName(event.currentTarget.value)} />
            <span className="hint">Defaults to the file name.</span>
          </div>
          <div className="field">
            <label htmlFor={`${ids}tip`}>Link that carries the tool</label>
            <input id={`${ids}tip`} value={tipLink} onChange={(event) => setTipLink(event.currentTarget.value.trim())} />
            <span className="hint">Required if the robot has several end links.</span>
          </div>
        </div>
        {create.error && <Problem error={create.error} title="The robot was rejected" />}
        {create.data && (
          <Notice tone="good" title={`${create.data.name}, version ${create.data.version}, was added`}>
            <p>
              <Link to={`/robots/${create.data.id}`}>Open</Link>
            </p>
          </Notice>
        )}
        <div>
          <button type="submit" className="button primary" disabled={create.isPending || file === null}>
            {create.isPending ? "Checking…" : "Add robot"}
          </button>
        </div>
      </form>
    </Card>
  );
}
