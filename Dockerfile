# The artifact on a fresh Debian 12:
#   docker build -t capsule .
#   docker run --rm -v "$PWD/out:/out" capsule sh -c 'make report && cp -r report.html figures tables /out'
FROM debian:12
RUN apt-get update && apt-get install -y --no-install-recommends git make
WORKDIR /capsule
COPY apt.txt Makefile ./
RUN make setup
COPY . .
RUN make build
CMD ["make", "figures"]
