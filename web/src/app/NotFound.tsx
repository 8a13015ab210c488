import { Link } from "react-router";
import { PageHead } from "../ui/basics";

export function NotFound() {
  return (
    <>
      <PageHead title="No such page" lead="The address leads nowhere in this dashboard." />
      <Link className="button" to="/jobs">
        To the jobs
      </Link>
    </>
  );
}
