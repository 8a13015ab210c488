import { Link } from "react-router";
import { PageHead } from "../ui/basics";

export function NotFound() {
  return (
    <>
      <PageHead title="Page not found" lead="This dashboard has no page at this address." />
      <Link className="button" to="/jobs">
        Go to jobs
      </Link>
    </>
  );
}
