import { Component, type ReactNode } from "react";
import { Problem } from "./feedback";

interface Props {
  /** What crashed, as a sentence. */
  title: string;
  children: ReactNode;
}

/** Shows the error of a part that crashed; the rest stays usable. */
export class ErrorBoundary extends Component<Props, { error: Error | null }> {
  override state: { error: Error | null } = { error: null };

  static getDerivedStateFromError(error: Error) {
    return { error };
  }

  override render() {
    const { error } = this.state;
    if (error === null) return this.props.children;
    return (
      <div className="stack">
        <Problem error={error} title={this.props.title} />
        <div>
          <button type="button" className="button" onClick={() => window.location.reload()}>
            Reload
          </button>
        </div>
      </div>
    );
  }
}
