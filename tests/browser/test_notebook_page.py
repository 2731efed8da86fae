"""A page in a notebook's cell: in a frame of a page of another name of this machine."""

import secrets
import threading
from http.server import BaseHTTPRequestHandler, HTTPServer

from pages import wait_until

from modeviz.viewer.page.server import open_server


def notebook_at(link: str) -> HTTPServer:
    """A web server whose every page has a link in a frame."""
    content = f'<!doctype html><iframe src="{link}" width="480" height="360"></iframe>'.encode()

    class Notebook(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, format: str, *arguments: object) -> None:
            pass

    return HTTPServer(("127.0.0.1", 0), Notebook)


def test_a_notebook_at_another_name_of_this_machine_shows_the_page(browser):
    server = open_server(port=0, token=secrets.token_urlsafe(), is_framed=True)
    notebook = notebook_at(server.local_link)
    threading.Thread(target=notebook.serve_forever, daemon=True).start()
    page = browser.new_page(viewport={"width": 520, "height": 400})
    try:
        page.goto(f"http://localhost:{notebook.server_port}/")
        wait_until(page, lambda: server.get_clients())
    finally:
        page.close()
        notebook.shutdown()
        server.stop()
