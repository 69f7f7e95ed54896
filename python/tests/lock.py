"""Whether the wheel is built of the same crates as the product: `lock.py Cargo.lock python/Cargo.lock`."""

import re
import sys

ENTRY = re.compile(r'name = "([^"]+)"\nversion = "([^"]+)"')


def crates(path):
    with open(path) as file:
        return set(ENTRY.findall(file.read()))


def main(product, wheel):
    ours, theirs = crates(product), crates(wheel)
    names = {name for name, _ in ours}
    other = sorted(f"{name} {version}" for name, version in theirs - ours if name in names)
    if other:
        sys.exit(f"{wheel} has other versions than {product}: {', '.join(other)}; copy {product} there and run cargo check in python/")


if __name__ == "__main__":
    main(*sys.argv[1:])
