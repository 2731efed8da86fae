"""Reading what a page holds."""

from typing import Any

from playwright.sync_api import Page


def wait_for(page: Page, expression: str, **arguments: Any) -> Any:
    """Waits until a JavaScript expression of `a`, the arguments, is true, and returns its value."""
    handle = page.wait_for_function(f"a => {expression}", arg=arguments, polling=100)
    return handle.json_value()
