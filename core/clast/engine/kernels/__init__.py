"""The compiled step loop, as a template.

Every module here is ordinary Python that imports its parts from ``slots``. For a scene, the assembler copies this
package into the cache under the digest of all its sources, beside a ``slots`` module that binds the scene's laws and
switches off what the scene does not need. The ``slots`` module kept here shows the names with an empty scene.
"""
