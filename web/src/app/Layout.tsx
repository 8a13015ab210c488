// The frame around every page: brand, navigation (a bar at the bottom of narrow screens), content.

import type { ReactNode } from "react";
import { Link, NavLink } from "react-router";
import { Icon, Mark, type IconName } from "../ui/icons";

const PLACES: { to: string; label: string; icon: IconName }[] = [
  { to: "/jobs", label: "Jobs", icon: "jobs" },
  { to: "/demonstrations", label: "Demonstrations", icon: "demonstrations" },
  { to: "/actions", label: "Actions", icon: "actions" },
  { to: "/robots", label: "Robots", icon: "robots" },
];

export function Layout({ children }: { children: ReactNode }) {
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
            <NavLink key={place.to} to={place.to}>
              <Icon name={place.icon} />
              {place.label}
            </NavLink>
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
