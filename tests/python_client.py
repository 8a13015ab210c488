"""Generates a Python client from the OpenAPI document and reads every example of a request with it.

Fails if openapi-python-client warns of anything, if an operation has no function, or if an example does not survive
the generated models. Usage: python tests/python_client.py OPENAPI_JSON
"""

import importlib
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def main(path: str) -> None:
    document = json.loads(Path(path).read_text())
    with tempfile.TemporaryDirectory() as folder:
        generate(path, folder)
        sys.path.insert(0, folder)
        operations = [operation for item in document["paths"].values() for operation in item.values()]
        for operation in operations:
            importlib.import_module(f"client.api.{operation['tags'][0]}.{snake_case(operation['operationId'])}")
        examples = sum(read_examples(document, operation) for operation in operations)
    print(f"openapi-python-client: {len(operations)} operations without a warning, {examples} examples read")


def generate(path: str, folder: str) -> None:
    """Writes the package `client` into `folder`; the generator's formatter lies beside it."""
    tools = Path(sys.executable).parent
    command = [tools / "openapi-python-client", "generate", "--meta", "none", "--fail-on-warning"]
    environment = {**os.environ, "PATH": f"{tools}{os.pathsep}{os.environ['PATH']}"}
    done = subprocess.run(
        [*command, "--path", path, "--output-path", f"{folder}/client"],
        env=environment,
        capture_output=True,
        text=True,
    )
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)


def read_examples(document: dict, operation: dict) -> int:
    """Turns each example into its model and back, and compares."""
    media = operation.get("requestBody", {}).get("content", {}).get("application/json")
    if media is None:
        return 0
    models = importlib.import_module("client.models")
    for name, example in media["examples"].items():
        model = getattr(models, class_name(document, media["schema"]["$ref"], example["value"]))
        written = model.from_dict(dict(example["value"])).to_dict()
        if written != example["value"]:
            sys.exit(f"{operation['operationId']}, {name}: {example['value']} came back as {written}")
    return len(media["examples"])


def class_name(document: dict, reference: str, value: dict) -> str:
    """The component of a value; of a union, the variant that its discriminator names."""
    name = reference.rsplit("/", 1)[1]
    discriminator = document["components"]["schemas"][name].get("discriminator")
    if discriminator is None:
        return name
    return class_name(document, discriminator["mapping"][value[discriminator["propertyName"]]], value)


def snake_case(name: str) -> str:
    return re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower()


if __name__ == "__main__":
    main(sys.argv[1])
