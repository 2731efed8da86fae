"""The notice on every page that what is asked for has no answer."""

from modeviz.errors import ModevizError
from modeviz.text.log import our_mistake
from modeviz.viewer.page.server import Server
from modeviz.viewer.page.widgets.alerts import alert, withdraw
from modeviz.viewer.session.notifications import Failed
from modeviz.viewer.session.worker import StuckError

NOT_SOLVED = "not solved"
"""The name of the notice, unless it is our mistake: each of these has a number."""

BACK = " You are back at the last state that was solved."


class Failures:
    """Says on all pages of a server what went wrong; the last good answer stays on the screen."""

    def __init__(self, server: Server) -> None:
        """Says nothing yet."""
        self._server = server

    def tell(self, failed: Failed) -> None:
        """Says why there is no answer."""
        name, text = self._notice(failed)
        for client in self._server.get_clients().values():
            alert(client, name, "Not solved", text)

    def withdraw(self) -> None:
        """Takes back that there is no answer, as there is one; our mistakes stay on the page."""
        for client in self._server.get_clients().values():
            withdraw(client, NOT_SOLVED)

    def _notice(self, failed: Failed) -> tuple[str, str]:
        """Return the name and the text of the notice."""
        error, text = failed.error, str(failed.error)
        if isinstance(error, ModevizError):
            return NOT_SOLVED, text
        name = self._server.note_mistake(error)
        hangs = f"{text[:1].upper()}{text[1:]}. " if isinstance(error, StuckError) else ""
        return name, f"{hangs}{our_mistake(name)}{BACK if failed.is_back else ''}"
