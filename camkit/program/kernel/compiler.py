"""LLVM (llvmlite): from text to machine code of this processor, and from that to a function."""

from __future__ import annotations

import ctypes
import platform
from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from llvmlite.binding import ExecutionEngine, TargetMachine

LEVEL = 2


@cache
def _target() -> TargetMachine:
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    features, target = llvm.get_host_cpu_features().flatten(), llvm.Target.from_default_triple()
    return target.create_target_machine(cpu=llvm.get_host_cpu_name(), features=features, opt=LEVEL, jit=True)


def processor() -> str:
    """This processor, this compiler and where numpy's functions come from."""
    import llvmlite
    import llvmlite.binding as llvm

    features = llvm.get_host_cpu_features().flatten()
    libraries = f"{llvmlite.__version__} {np.__version__} {platform.libc_ver()[1] or platform.release()}"
    return f"{llvm.get_default_triple()} {llvm.get_host_cpu_name()} {features} {libraries}"


@cache
def lanes() -> int:
    """How many doubles it takes at once."""
    import llvmlite.binding as llvm

    return 8 if llvm.get_host_cpu_features().get("avx512f") else 4


def machine_code(text: str) -> bytes:
    """The machine code of a text of LLVM's, strictly as it is written."""
    import llvmlite.binding as llvm

    target = _target()
    head = f'target triple = "{llvm.get_default_triple()}"\ntarget datalayout = "{target.target_data}"\n'
    module = llvm.parse_assembly(head + text)
    module.verify()
    return bytes(target.emit_object(module))


def loaded(code: bytes) -> tuple[Callable[..., None], ExecutionEngine]:
    """The function ``kernel`` of machine code, which is there as long as the other; threads go on while it runs."""
    import llvmlite.binding as llvm

    _target()
    empty = llvm.parse_assembly(f'target triple = "{llvm.get_default_triple()}"')
    engine = llvm.create_mcjit_compiler(empty, llvm.Target.from_default_triple().create_target_machine(jit=True))
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    kind = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 5, *[ctypes.c_int64] * 3)
    return kind(engine.get_function_address("kernel")), engine
