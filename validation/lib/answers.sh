#!/bin/sh
# What the tests of the program's answers share; read by them with `.`, where $capsule is the program.

fail() {
  echo "FAILED: $*"
  cat log
  exit 1
}
# ends CODE ARGUMENT...: the program does, with this code; what it says goes into log
ends() {
  expected=$1
  shift
  code=0
  "$capsule" "$@" >log 2>&1 || code=$?
  [ "$code" -eq "$expected" ] || fail "'$*' ended with $code, not with $expected"
}
