//! Access to what is kept of motions: requests, and what came of each, a table and a file each.

use hammerbeam_attractor::{Attractor, Round};

use super::{
    ExponentRecord, RequestKind, RequestRecord, SettledMotion, SimulatedChunk, SimulationLayout, Store,
    StoreError, basins, exponents, requests, settled, simulated,
};

impl Store {
    /// The request of that kind and of those words; added if it is new.
    ///
    /// * `pieces`: how many pieces of work it has.
    ///
    /// # Errors
    /// The database refuses.
    pub fn request(
        &mut self,
        kind: RequestKind,
        words: &str,
        pieces: u64,
    ) -> Result<RequestRecord, StoreError> {
        requests::request(self.write()?, kind, words, pieces)
    }

    /// All requests in the order in which they came.
    ///
    /// # Errors
    /// The database refuses, or a kind is unknown.
    pub fn requests(&self) -> Result<Vec<RequestRecord>, StoreError> {
        requests::requests(&self.connection)
    }

    /// Motions of a request, in their order.
    ///
    /// # Errors
    /// The database refuses, or something in it is damaged.
    pub fn settled(&self, request: i64) -> Result<Vec<SettledMotion>, StoreError> {
        settled::settled(&self.connection, request)
    }

    /// Adds the motions of a piece of a request.
    ///
    /// * `piece`: its number, counted from 0; those before it are done.
    ///
    /// # Errors
    /// The database refuses, or the pieces before it are not done; nothing of it is there then.
    pub fn append_settled(
        &mut self,
        request: i64,
        piece: u64,
        motions: &[SettledMotion],
    ) -> Result<(), StoreError> {
        settled::append_settled(self.write()?, request, piece, motions)
    }

    /// Spectra of a request, in their order.
    ///
    /// # Errors
    /// The database refuses, or something in it is damaged.
    pub fn exponents(&self, request: i64) -> Result<Vec<ExponentRecord>, StoreError> {
        exponents::exponents(&self.connection, request)
    }

    /// Adds a spectrum to a request.
    ///
    /// * `piece`: its number, counted from 0; those before it are done.
    ///
    /// # Errors
    /// The database refuses, or the pieces before it are not done; nothing of it is there then.
    pub fn append_exponents(
        &mut self,
        request: i64,
        piece: u64,
        record: &ExponentRecord,
    ) -> Result<(), StoreError> {
        exponents::append_exponents(self.write()?, request, piece, record)
    }

    /// Basins of a request: the attractor of each cell, from the first one on, and the attractors.
    ///
    /// # Errors
    /// The database refuses, or something in it is damaged.
    pub fn basins(&self, request: i64) -> Result<(Vec<u32>, Vec<Attractor>), StoreError> {
        basins::basins(&self.connection, request)
    }

    /// Adds a round to the basins of a request.
    ///
    /// * `known`: number of attractors that were known before it.
    ///
    /// # Errors
    /// The database refuses, or the cells before it are not done; nothing of the round is there then.
    pub fn append_round(&mut self, request: i64, round: &Round, known: usize) -> Result<(), StoreError> {
        basins::append_round(self.write()?, request, round, known)
    }

    /// Goes through the chunks of a request, in their order; all is of one moment, even while a command
    /// writes.
    ///
    /// # Errors
    /// The database refuses, or what is stored is damaged: periods that are done are missing, or something
    /// has not the length or the number that the layout gives; or what `take` refuses with.
    pub fn each_simulated<E: From<StoreError>>(
        &self,
        request: i64,
        layout: &SimulationLayout,
        take: impl FnMut(SimulatedChunk) -> Result<(), E>,
    ) -> Result<(), E> {
        simulated::each_simulated(&self.connection, request, layout, take)
    }

    /// Adds periods to a request.
    ///
    /// * `first`: the number of periods before them, which are done.
    ///
    /// # Errors
    /// The database refuses, or the periods before them are not done; nothing of them is there then.
    pub fn append_simulated(
        &mut self,
        request: i64,
        first: u64,
        chunk: &SimulatedChunk,
    ) -> Result<(), StoreError> {
        simulated::append_simulated(self.write()?, request, first, chunk)
    }
}
