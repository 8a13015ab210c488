// The frame around every page: brand, navigation (a bar at the bottom of narrow screens), content.

import type { ReactNode } from "react";
import { Link, useLocation } from "react-router";
import { Icon, Mark, type IconName } from "../ui/icons";

/** Entries of the navigation; one is current on the pages whose path starts with one of `covers`. */
const PLACES: { to: string; label: string; icon: IconName; covers: string[] }[] = [
  { to: "/jobs", label: "Jobs", icon: "jobs", covers: ["/jobs", "/runs"] },
  { to: "/demonstrations", label: "Demonstrations", icon: "demonstrations", covers: ["/demonstrations"] },
  { to: "/actions", label: "Actions", icon: "actions", covers: ["/actions"] },
  { to: "/robots", label: "Robots", icon: "robots", covers: ["/robots"] },
];

export function Layout({ children }: { children: ReactNode }) {
  const { pathname } = useLocation();
  return (
    <div className="shell">
      <a className="skip" href="#content">
        Skip to content
      </a>
      <header className="side">
        <Link className="brand" to="/jobs">
          <Mark /> cgda
        </Link>
        <nav className="nav" aria-label="Main">
          {PLACES.map((place) => (
            <Link key={place.to} to={place.to} aria-current={place.covers.some((path) => pathname.startsWith(path)) ? "page" : undefined}>
              <Icon name={place.icon} />
              {place.label}
            </Link>
          ))}
        </nav>
        <p className="side-foot muted">
          API: <a href="/openapi.json">OpenAPI</a>
        </p>
      </header>
      <main className="content" id="content" tabIndex={-1}>
        {children}
      </main>
    </div>
  );
}
