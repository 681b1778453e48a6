"""What mkdocs calls while it builds the site; see ``sitebuild/events.py``."""

from sitebuild.events import on_config, on_files, on_page_content, on_page_markdown, on_post_build

__all__ = ["on_config", "on_files", "on_page_content", "on_page_markdown", "on_post_build"]
