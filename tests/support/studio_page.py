"""What the tests of the studio's page do with it."""

from contextlib import contextmanager

from benchmarks.studio import DONE, painted, until

LEAF = "scan"
SQUARE = b"0,0\n" + b"".join(f"{10 * (k // 10)},{k}\n".encode() for k in range(1, 11))


def example(page, name):
    page.select_option("#examples", name)
    until(page, f"() => studio.scene.shape.name.startsWith({name!r})")
    until(page, DONE)


@contextmanager
def unheard(page, *kinds):
    """The page hears nothing of some kinds, so that what is under way stays so on any machine."""
    page.evaluate(
        """(kinds) => {
          const { wire } = studio;
          wire.hearsAll = wire.hear;
          wire.hear = (message) => kinds.includes(message.type) || wire.hearsAll(message);
        }""",
        kinds,
    )
    yield
    page.evaluate("() => { studio.wire.hear = studio.wire.hearsAll; }")


def own(page):
    return page.evaluate("studio.store.now.own")


def place_of_node(page, node):
    """Of a node of the first outline: x and y on the page, and its point."""
    return page.evaluate(
        f"""() => {{
          const fit = studio.fitter.fits[0];
          const at = studio.scene.view.toScreen(fit.nodes[{2 * node}], fit.nodes[{2 * node + 1}]);
          const box = studio.scene.canvas.getBoundingClientRect();
          return [at[0] + box.left, at[1] + box.top, fit.points[{node}]];
        }}"""
    )


def dropped(page, name, content):
    page.evaluate(
        """([name, bytes]) => {
          const held = new DataTransfer();
          held.items.add(new File([new Uint8Array(bytes)], name));
          dispatchEvent(new DragEvent("drop", { dataTransfer: held }));
        }""",
        [name, list(content)],
    )


def text(page):
    painted(page)
    return page.inner_text("#sentence")
