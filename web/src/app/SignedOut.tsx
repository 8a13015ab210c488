import { Mark } from "../ui/icons";

/** Shown after a 401: the server was restarted with a new token, or this browser never had one. */
export function SignedOut() {
  return (
    <main className="content" style={{ maxWidth: 620 }}>
      <title>Signed out · cgda</title>
      <section className="card stack">
        <div className="row">
          <Mark />
          <h1>This browser has no valid token</h1>
        </div>
        <p>
          At start-up, <code>cgda serve</code> prints an address that ends in <code>?token=…</code>. Open it once; the token
          is then stored as a cookie in this browser.
        </p>
        <p className="muted">
          After a restart with a new token, open the new address. If the server runs as a service, look for it in the log, for
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
