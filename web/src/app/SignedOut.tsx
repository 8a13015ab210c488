import { Mark } from "../ui/icons";

/** Shown after a 401: the server was restarted with another token, or this browser never had one. */
export function SignedOut() {
  return (
    <main className="content" style={{ maxWidth: 620 }}>
      <title>Signed out · cgda</title>
      <section className="card stack">
        <div className="row">
          <Mark />
          <h1>This browser holds no valid token</h1>
        </div>
        <p>
          When it starts, <code>cgda serve</code> prints a ready-to-open address that ends in <code>?token=…</code>. Open that
          address once; the token becomes a cookie of this browser.
        </p>
        <p className="muted">
          A server that was restarted with a new token needs its new address. In a service the line is in its log, for
          example <code>journalctl -u cgda</code> or <code>docker logs cgda</code>.
        </p>
        <div>
          <button type="button" className="button primary" onClick={() => window.location.reload()}>
            Try again
          </button>
        </div>
      </section>
    </main>
  );
}
